// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FitsFile.h"

#include "sensornoise/FrameFile.h"
#include "files/FitsFrames.h"
#include "files/FitsHeader.h"
#include "files/FrameSizes.h"
#include "files/TextHeader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

namespace sensornoise
{
namespace
{
bool
IsImageOfFits(const FitsHeader & header)
{
  const std::string extension = header.Text("XTENSION");
  return (extension.empty() || extension == "IMAGE") && !header.axes.empty();
}

/** The only image of the file. */
FitsHeader
FindImage(const std::string & file, FileBytes & bytes)
{
  std::vector<FitsHeader> images;
  std::uint64_t           offset = 0;
  for (std::size_t unit = 0; offset < bytes.Size(); ++unit)
  {
    const std::string name = unit == 0 ? file : file + ", HDU " + std::to_string(unit);
    if (unit > 0)
    {
      std::array<char, 8> head{};
      bytes.ReadSome(offset, head.data(), head.size());
      if (std::string(head.begin(), head.end()) != "XTENSION")
      {
        throw FileError(name,
                        "damaged: at byte " + std::to_string(offset) +
                          " is no extension; expected XTENSION there, or the end of the file");
      }
    }
    const FitsHeader header = ReadFitsHeader(name, bytes, offset);
    if (header.Text("ZIMAGE") == "T")
    {
      throw FileError(name, "an image in compressed tiles; expected one without compression: funpack FILE");
    }
    if (IsImageOfFits(header))
    {
      images.push_back(header);
    }
    offset = header.next;
  }
  if (images.size() != 1)
  {
    throw FileError(
      file, "has " + std::to_string(images.size()) + " images; expected one, a frame or a stack, in a file of its own");
  }
  return images.front();
}

/** Throws FileError unless the data have the checksum that the header may give: the sum of all 32-bit numbers, highest
 * byte first, in ones' complement. FITS standard, Appendix J. */
void
CheckDataSum(const FitsHeader & header, FileBytes & bytes)
{
  const std::optional<std::int64_t> expected = header.Integer("DATASUM");
  if (!expected)
  {
    return;
  }
  std::uint64_t sum = 0;
  std::uint32_t word = 0;
  ByteReader    reader(bytes, header.dataBegin, header.dataBegin + header.dataBytes);
  std::size_t   count = 0;
  for (int byte = reader.Next(); byte >= 0; byte = reader.Next())
  {
    word = (word << 8) | static_cast<std::uint32_t>(byte);
    if (++count % 4 == 0)
    {
      sum += word;
      sum = (sum & 0xFFFFFFFF) + (sum >> 32);
      word = 0;
    }
  }
  if (count % 4 != 0) // zeros fill the block
  {
    sum += static_cast<std::uint64_t>(word) << (8 * (4 - count % 4));
    sum = (sum & 0xFFFFFFFF) + (sum >> 32);
  }
  // 0 and all bits set are the same number in ones' complement
  const std::uint64_t given = static_cast<std::uint64_t>(*expected);
  if (sum % 0xFFFFFFFF != given % 0xFFFFFFFF)
  {
    throw FileError(header.name,
                    "damaged: the checksum of its data is " + std::to_string(sum) + ", expected DATASUM, " +
                      std::to_string(given));
  }
}

/** Which numbers the data are, and what makes values of them. */
FitsScale
ScaleOfFits(const FitsHeader & header)
{
  FitsScale scale;
  scale.bitsOfPixel = static_cast<int>(header.bitsOfPixel);
  scale.factor = header.Number("BSCALE").value_or(1.0);
  scale.zero = header.Number("BZERO").value_or(0.0);
  scale.blank = header.bitsOfPixel > 0 ? header.Integer("BLANK") : std::nullopt;
  if (scale.factor == 0.0)
  {
    throw FileError(header.name, "damaged: BSCALE is 0; expected another number");
  }
  if (header.bitsOfPixel == 64)
  {
    throw FileError(header.name, UnsupportedPixel("long long"));
  }
  return scale;
}

/** The pattern counts from the first row of the file only if the header says so. */
void
ReadCameraOfFits(const FitsHeader & header, CameraSettings & camera)
{
  camera.camera = PrintableText(header.Text("INSTRUME"));
  const std::string pattern = header.Text("BAYERPAT");
  const auto        isZero = [&header](const char * key) {
    const std::string text = header.Text(key);
    return text.empty() || std::atof(text.c_str()) == 0.0;
  };
  for (const char * const known : { "RGGB", "GRBG", "GBRG", "BGGR" })
  {
    if (pattern == known && header.Text("ROWORDER") == "TOP-DOWN" && isZero("XBAYROFF") && isZero("YBAYROFF"))
    {
      camera.bayerPattern = pattern;
    }
  }
  for (const char * const key : { "EXPTIME", "EXPOSURE" })
  {
    const double seconds = std::atof(header.Text(key).c_str());
    if (seconds > 0.0)
    {
      camera.exposureSeconds = seconds;
      return;
    }
  }
}
} // namespace

bool
IsHeadOfFits(const std::string & head, const std::string & /*name*/)
{
  return head.rfind("SIMPLE  = ", 0) == 0;
}

void
InspectFits(FileBytes & bytes, FrameFile & file, const BeforeInflating & /*beforeInflating*/)
{
  const FitsHeader           image = FindImage(file.name, bytes);
  std::vector<std::uint64_t> sizes = image.axes;
  while (sizes.size() > 3 && sizes.back() == 1)
  {
    sizes.pop_back();
  }
  const FitsScale scale = ScaleOfFits(image);
  file.pixel = PixelOf(scale);
  SetFrameSizes(file, sizes);
  CheckDataSum(image, bytes);
  file.reader = std::make_shared<FitsFrames>(image.dataBegin, scale);
  ReadCameraOfFits(image, file.camera);
}

} // namespace sensornoise
