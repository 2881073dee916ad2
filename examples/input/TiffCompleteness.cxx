/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "input/FormatCompleteness.h"
#include "input/TextHeader.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <tiffio.h>

namespace sensornoise::tools
{
namespace
{
struct TiffCloser
{
  void
  operator()(TIFF * tiff) const
  {
    TIFFClose(tiff);
  }
};

/** Throws unless ITK reads the samples of the page without conversion. */
void
CheckTiffSamples(TIFF * tiff, const std::string & page, const itk::ImageIOBase & io)
{
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);

  if (samples != 1 || photometric == PHOTOMETRIC_PALETTE)
  {
    Refuse(page,
           std::to_string(samples) + (samples == 1 ? " component" : " components") + " a pixel" +
             (photometric == PHOTOMETRIC_PALETTE ? " with a palette of colours" : "") + "; expected 1 grey value");
  }
  if (TIFFIsTiled(tiff) != 0)
  {
    Refuse(page, "a tiled TIFF, which ITK converts to 8-bit colours; expected a TIFF with strips");
  }
  const std::size_t          expectedBits = 8 * io.GetComponentSize();
  const bool                 isFloat = format == SAMPLEFORMAT_IEEEFP;
  const bool                 isSigned = format == SAMPLEFORMAT_INT;
  const itk::IOComponentEnum component = io.GetComponentType();
  const bool                 expectFloat = component == itk::IOComponentEnum::FLOAT;
  const bool expectSigned = component == itk::IOComponentEnum::SHORT || component == itk::IOComponentEnum::CHAR ||
                            component == itk::IOComponentEnum::INT;
  if (bits != expectedBits || isFloat != expectFloat || isSigned != expectSigned)
  {
    Refuse(page,
           std::to_string(bits) + "-bit " +
             (isFloat    ? "floating-point"
              : isSigned ? "signed"
                         : "unsigned") +
             " samples, which ITK reads as " + itk::ImageIOBase::GetComponentTypeAsString(component) +
             "; expected 8-bit unsigned, 16-bit, or 32-bit floating-point samples, the same on all pages");
  }
}

/** Throws unless all bytes of the page lie within the file, of `size` bytes. */
void
CheckTiffStrips(TIFF * tiff, const std::string & page, std::uint64_t size)
{
  for (std::uint32_t strip = 0; strip < TIFFNumberOfStrips(tiff); ++strip)
  {
    const std::uint64_t offset = TIFFGetStrileOffset(tiff, strip);
    const std::uint64_t count = TIFFGetStrileByteCount(tiff, strip);
    if (offset == 0 || count == 0 || offset > size || count > size - offset)
    {
      Refuse(page,
             "truncated: its strip " + std::to_string(strip) + " is at bytes " + std::to_string(offset) + " to " +
               std::to_string(offset + count) + ", but the file has " + std::to_string(size));
    }
  }
}

/** Throws unless ITK reads the page as it is: with the size of the first one, and without conversion. */
void
CheckTiffPage(TIFF * tiff, const std::string & page, const itk::ImageIOBase & io, std::uint64_t size)
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
  CheckTiffSamples(tiff, page, io);
  if (width != io.GetDimensions(0) || height != io.GetDimensions(1))
  {
    Refuse(page,
           std::to_string(width) + " x " + std::to_string(height) + " pixels, but the first page has " +
             std::to_string(io.GetDimensions(0)) + " x " + std::to_string(io.GetDimensions(1)) +
             "; all pages must have the same size");
  }
  CheckTiffStrips(tiff, page, size);
}
} // namespace

void
CheckTiff(const std::string & file, const itk::ImageIOBase & io)
{
  const std::uint64_t size = SizeOfFile(file, file);
  // m: read, do not map; c: do not cut one large strip into imagined small ones
  const std::unique_ptr<TIFF, TiffCloser> tiff(TIFFOpen(file.c_str(), "rmc"));
  if (!tiff)
  {
    Refuse(file, "libtiff cannot read its first page; the file is damaged or truncated");
  }
  const char *      text = nullptr;
  const std::string description = TIFFGetField(tiff.get(), TIFFTAG_IMAGEDESCRIPTION, &text) != 0 ? text : "";

  const std::uint64_t frames = io.GetNumberOfDimensions() > 2 ? io.GetDimensions(2) : 1;
  std::uint64_t       pages = 0;
  for (bool more = true; more;)
  {
    CheckTiffPage(tiff.get(), pages == 0 ? file : file + ", page " + std::to_string(pages), io, size);
    ++pages;
    more = TIFFLastDirectory(tiff.get()) == 0;
    if (more && TIFFReadDirectory(tiff.get()) == 0)
    {
      Refuse(file,
             "truncated: " + std::to_string(pages) + " of its pages can be read, but the file says that more follow");
    }
  }
  // also where the offset of the next page is cut off, which libtiff takes for the end and ITK for an error
  if (pages != frames)
  {
    Refuse(file, "pages: " + std::to_string(pages) + ", but ITK reads " + std::to_string(frames) + " frames of them");
  }
  // ImageJ writes a stack above 4 GiB as one page and says in words how many follow
  const std::size_t images = description.rfind("ImageJ=", 0) == 0 ? description.find("\nimages=") : std::string::npos;
  if (images != std::string::npos && std::strtoull(description.c_str() + images + 8, nullptr, 10) != pages)
  {
    Refuse(file,
           "pages: " + std::to_string(pages) + ", but ImageJ's description of it says " +
             Trimmed(description.substr(images + 1, description.find('\n', images + 1) - images - 1)));
  }
}

} // namespace sensornoise::tools
