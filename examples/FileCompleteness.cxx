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
#include "FileCompleteness.h"

#include "itkMetaImageIO.h"

#include <tiffio.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

[[noreturn]] void
Refuse(const std::string & file, const std::string & what)
{
  throw InputError(file + ": " + what);
}

std::uint64_t
SizeOfFile(const std::string & file, const fs::path & dataFile)
{
  std::error_code      error;
  const std::uintmax_t size = fs::file_size(dataFile, error);
  if (error)
  {
    Refuse(file, "its data file " + dataFile.string() + " does not exist or cannot be read");
  }
  return size;
}

void
RequireBytes(const std::string & file, const fs::path & dataFile, std::uint64_t offset, std::uint64_t expected)
{
  const std::uint64_t size = SizeOfFile(file, dataFile);
  const std::uint64_t found = size > offset ? size - offset : 0;
  if (found < expected)
  {
    const std::string place = fs::path(file) == dataFile ? "" : " in its data file " + dataFile.string();
    Refuse(file,
           "truncated: " + std::to_string(found) + " bytes of pixels" + place + ", expected " +
             std::to_string(expected));
  }
}

std::string
Trimmed(const std::string & text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/** A text header: lines of a key, a separator and a value. */
struct TextHeader
{
  std::map<std::string, std::string> fields;
  std::vector<std::string>           lines; // what follows the header, of interest if it is a list of files
  std::uint64_t                      end{ 0 };

  std::string
  Field(const std::string & key) const
  {
    const auto found = fields.find(key);
    return found == fields.end() ? "" : found->second;
  }
};

/** Reads up to the line with the key `last`, or, without one, up to a line that is empty. */
TextHeader
ReadTextHeader(const std::string & file, const char * separators, const std::string & last)
{
  TextHeader    header;
  std::ifstream stream(file, std::ios::binary);
  std::string   line;
  while (std::getline(stream, line) && !(last.empty() && Trimmed(line).empty()))
  {
    const std::size_t separator = line.find_first_of(separators);
    if (separator == std::string::npos || line[0] == '#')
    {
      continue;
    }
    const std::string key = Trimmed(line.substr(0, separator));
    header.fields[key] = Trimmed(line.substr(separator + 1));
    if (key == last)
    {
      break;
    }
  }
  header.end = stream ? static_cast<std::uint64_t>(stream.tellg()) : fs::file_size(file);
  if (header.Field(last).rfind("LIST", 0) == 0)
  {
    // MetaIO drops a last line that has no end
    while (std::getline(stream, line) && !stream.eof())
    {
      header.lines.push_back(Trimmed(line));
    }
  }
  return header;
}

void
CheckMetaImage(const std::string & file, itk::MetaImageIO & io)
{
  const TextHeader    header = ReadTextHeader(file, "=:", "ElementDataFile");
  const std::string   dataFile = header.Field("ElementDataFile");
  const fs::path      folder = fs::path(file).parent_path();
  const std::uint64_t bytes = io.GetImageSizeInBytes();
  const int           headerSize = io.GetMetaImagePointer()->HeaderSize();
  const std::uint64_t skipped = headerSize > 0 ? static_cast<std::uint64_t>(headerSize) : 0;

  if (!io.GetMetaImagePointer()->BinaryData())
  {
    Refuse(file, "BinaryData is False, and pixels written as text cannot be checked; expected binary pixels");
  }
  if (dataFile.find('%') != std::string::npos)
  {
    Refuse(file, "ElementDataFile is the pattern " + dataFile + "; expected LOCAL, LIST or the name of one file");
  }
  std::uint64_t expected = bytes;
  if (io.GetMetaImagePointer()->CompressedData())
  {
    expected = std::strtoull(header.Field("CompressedDataSize").c_str(), nullptr, 10);
    if (expected == 0)
    {
      Refuse(file, "compressed without a CompressedDataSize in the header; without it nobody can tell if it is whole");
    }
  }
  if (dataFile == "LOCAL" || dataFile == "Local" || dataFile == "local")
  {
    RequireBytes(file, file, skipped > 0 ? skipped : header.end, expected);
  }
  else if (dataFile.rfind("LIST", 0) == 0)
  {
    const std::uint64_t frames = io.GetNumberOfDimensions() == 3 ? io.GetDimensions(2) : 0;
    const std::string   dimension = Trimmed(dataFile.substr(4));
    if (frames == 0 || !(dimension.empty() || dimension == "2"))
    {
      Refuse(file, "ElementDataFile is " + dataFile + "; expected a list with one file for each frame of a 3-D image");
    }
    if (header.lines.size() < frames)
    {
      Refuse(file,
             "truncated: " + std::to_string(header.lines.size()) + " whole lines in its list of data files, expected " +
               std::to_string(frames));
    }
    for (std::uint64_t frame = 0; frame < frames; ++frame)
    {
      RequireBytes(file, folder / header.lines[frame], skipped, expected / frames);
    }
  }
  else
  {
    RequireBytes(file, folder / dataFile, skipped, expected);
  }
}

void
CheckNrrd(const std::string & file, std::uint64_t bytes)
{
  const TextHeader  header = ReadTextHeader(file, ":", "");
  const std::string dataFile = header.Field("data file") + header.Field("datafile");
  const std::string skip = header.Field("byte skip") + header.Field("byteskip");
  const bool        severalFiles = dataFile.rfind("LIST", 0) == 0 || dataFile.find('%') != std::string::npos;
  if (header.Field("encoding") != "raw" || severalFiles)
  {
    return;
  }
  // a skip of -1 means that the pixels are at the end
  const std::uint64_t skipped = skip.empty() || skip[0] == '-' ? 0 : std::strtoull(skip.c_str(), nullptr, 10);
  const fs::path      path = dataFile.empty() ? fs::path(file) : fs::path(file).parent_path() / dataFile;
  RequireBytes(file, path, skipped + (dataFile.empty() ? header.end : 0), bytes);
}

void
CheckPng(const std::string & file)
{
  std::ifstream       stream(file, std::ios::binary);
  const std::uint64_t size = SizeOfFile(file, file);
  std::uint64_t       chunk = 8;
  for (std::array<unsigned char, 8> head{};
       stream.seekg(chunk) && stream.read(reinterpret_cast<char *>(head.data()), head.size());)
  {
    const std::uint64_t length = (std::uint64_t{ head[0] } << 24) | (head[1] << 16) | (head[2] << 8) | head[3];
    chunk += length + 12;
    if (std::string(head.begin() + 4, head.end()) == "IEND" && chunk <= size)
    {
      return;
    }
  }
  Refuse(file, "truncated: " + std::to_string(size) + " bytes without the IEND chunk that ends a PNG file");
}

struct TiffCloser
{
  void
  operator()(TIFF * tiff) const
  {
    TIFFClose(tiff);
  }
};

/** Throws unless ITK reads the page as it is: with the size of the first one, and without conversion. */
void
CheckTiffPage(TIFF * tiff, const std::string & page, const itk::ImageIOBase & io, std::uint64_t size)
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
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
  if (width != io.GetDimensions(0) || height != io.GetDimensions(1))
  {
    Refuse(page,
           std::to_string(width) + " x " + std::to_string(height) + " pixels, but the first page has " +
             std::to_string(io.GetDimensions(0)) + " x " + std::to_string(io.GetDimensions(1)) +
             "; all pages must have the same size");
  }
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

} // namespace

void
CheckFileIsComplete(itk::ImageIOBase & io)
{
  const std::string file = io.GetFileName();
  const std::string format = io.GetNameOfClass();
  if (auto * const metaImageIO = dynamic_cast<itk::MetaImageIO *>(&io))
  {
    CheckMetaImage(file, *metaImageIO);
  }
  else if (format == "TIFFImageIO")
  {
    CheckTiff(file, io);
  }
  else if (format == "PNGImageIO")
  {
    CheckPng(file);
  }
  else if (format == "NrrdImageIO")
  {
    CheckNrrd(file, io.GetImageSizeInBytes());
  }
  else if (format != "HDF5ImageIO" && format != "MINCImageIO")
  {
    const std::uint64_t found = SizeOfFile(file, file);
    const std::uint64_t expected = io.GetImageSizeInBytes();
    if (found < expected)
    {
      Refuse(file,
             std::to_string(found) + " bytes, fewer than the " + std::to_string(expected) +
               " of its pixels; truncated, or compressed in a format that cannot be checked; expected TIFF, PNG, "
               "MetaImage or NRRD");
    }
  }
}

} // namespace sensornoise::tools
