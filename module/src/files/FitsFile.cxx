// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FrameReader.h"
#include "files/TextHeader.h"
#include "base/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

namespace sensornoise
{
namespace
{
/** Numbers of a FITS image and their scale: value = zero + factor * number. */
struct FitsScale
{
  int                         bitsOfPixel{ 16 }; // BITPIX; below 0: floating point
  double                      factor{ 1.0 };     // BSCALE
  double                      zero{ 0.0 };       // BZERO
  std::optional<std::int64_t> blank{};           // BLANK, the number of pixels without a value
};

/** Converts numbers in the byte order of this machine to pixels. Pixels without a value are NaN. */
template <typename TStored, typename TPixel>
void
ScaleNumbers(const FitsScale & scale, const unsigned char * numbers, std::size_t count, void * pixels)
{
  auto * const to = static_cast<TPixel *>(pixels);
  for (std::size_t i = 0; i < count; ++i)
  {
    TStored number;
    std::memcpy(&number, numbers + i * sizeof(TStored), sizeof(TStored));
    if constexpr (std::numeric_limits<TStored>::is_integer && !std::numeric_limits<TPixel>::is_integer)
    {
      if (scale.blank && *scale.blank == std::int64_t{ number })
      {
        to[i] = std::numeric_limits<TPixel>::quiet_NaN();
        continue;
      }
    }
    if constexpr (sizeof(TStored) == sizeof(TPixel) && !std::numeric_limits<TStored>::is_integer)
    {
      to[i] = scale.factor == 1.0 && scale.zero == 0.0
                ? static_cast<TPixel>(number) // also -0 and NaN
                : static_cast<TPixel>(scale.zero + scale.factor * static_cast<double>(number));
    }
    else
    {
      to[i] = static_cast<TPixel>(scale.zero + scale.factor * static_cast<double>(number));
    }
  }
}

template <typename TStored>
void
ScaleTo(FramePixel pixel, const FitsScale & scale, const unsigned char * numbers, std::size_t count, void * pixels)
{
  switch (pixel)
  {
    case FramePixel::UnsignedChar:
      return ScaleNumbers<TStored, unsigned char>(scale, numbers, count, pixels);
    case FramePixel::UnsignedShort:
      return ScaleNumbers<TStored, unsigned short>(scale, numbers, count, pixels);
    case FramePixel::Short:
      return ScaleNumbers<TStored, short>(scale, numbers, count, pixels);
    case FramePixel::Float:
      return ScaleNumbers<TStored, float>(scale, numbers, count, pixels);
    case FramePixel::Double:
      return ScaleNumbers<TStored, double>(scale, numbers, count, pixels);
  }
}

void
ScaleAll(FramePixel pixel, const FitsScale & scale, const unsigned char * numbers, std::size_t count, void * pixels)
{
  switch (scale.bitsOfPixel)
  {
    case 8:
      return ScaleTo<std::uint8_t>(pixel, scale, numbers, count, pixels);
    case 16:
      return ScaleTo<std::int16_t>(pixel, scale, numbers, count, pixels);
    case 32:
      return ScaleTo<std::int32_t>(pixel, scale, numbers, count, pixels);
    case -32:
      return ScaleTo<float>(pixel, scale, numbers, count, pixels);
    default:
      return ScaleTo<double>(pixel, scale, numbers, count, pixels);
  }
}

/** Returns the smallest pixel type that represents each value exactly; double for a scale with other values and for
 * pixels without a value. */
FramePixel
PixelOf(const FitsScale & scale)
{
  constexpr double unsignedZero = 32768.0;
  if (scale.factor == 1.0 && !scale.blank)
  {
    if (scale.bitsOfPixel == 8 && scale.zero == 0.0)
    {
      return FramePixel::UnsignedChar;
    }
    if (scale.bitsOfPixel == 16 && (scale.zero == 0.0 || scale.zero == unsignedZero))
    {
      return scale.zero == 0.0 ? FramePixel::Short : FramePixel::UnsignedShort;
    }
    if (scale.bitsOfPixel == -32 && scale.zero == 0.0)
    {
      return FramePixel::Float;
    }
  }
  return FramePixel::Double;
}

/** Reads frames of a FITS image. */
class FitsFrames : public FrameReader
{
public:
  /** \a begin: offset of the first pixel [bytes]. */
  FitsFrames(std::uint64_t begin, const FitsScale & scale)
    : m_Begin(begin)
    , m_Scale(scale)
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override;

private:
  std::uint64_t m_Begin;
  FitsScale     m_Scale;
};

void
FitsFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  constexpr std::size_t      block = std::size_t{ 1 } << 17; // pixels per block: 1 MiB as double
  FileBytes                  bytes(file.name);
  const std::size_t          size = static_cast<std::size_t>(std::abs(m_Scale.bitsOfPixel)) / 8;
  const std::size_t          frame = file.width * file.height;
  const std::size_t          pixels = frame * count;
  std::vector<unsigned char> numbers(std::min(pixels, block) * size);
  for (std::size_t done = 0; done < pixels; done += block)
  {
    const std::size_t now = std::min(block, pixels - done);
    bytes.Read(m_Begin + (first * frame + done) * size, numbers.data(), now * size);
    ToOwnByteOrder(true, size, now, numbers.data());
    ScaleAll(file.pixel, m_Scale, numbers.data(), now, static_cast<char *>(buffer) + done * SizeOf(file.pixel));
  }
}

bool
IsImageOfFits(const FitsHeader & header)
{
  const std::string extension = header.Text("XTENSION");
  return (extension.empty() || extension == "IMAGE") && !header.axes.empty();
}

/** Returns the header of the only image of the file. Throws FileError unless there is exactly one, without compression.
 */
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

/** Throws FileError unless the data have the checksum of the header, if it gives one: the sum of all 32-bit numbers,
 * highest byte first, in ones' complement (FITS standard, Appendix J). */
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
  if (count % 4 != 0) // zeros pad the block
  {
    sum += static_cast<std::uint64_t>(word) << (8 * (4 - count % 4));
    sum = (sum & 0xFFFFFFFF) + (sum >> 32);
  }
  // 0 and all bits set are equal in ones' complement
  const std::uint64_t given = static_cast<std::uint64_t>(*expected);
  if (sum % 0xFFFFFFFF != given % 0xFFFFFFFF)
  {
    throw FileError(header.name,
                    "damaged: the checksum of its data is " + std::to_string(sum) + ", expected DATASUM, " +
                      std::to_string(given));
  }
}

/** Returns the type of the numbers and their scale. Throws FileError for BSCALE 0 and integers of 64 bits. */
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

/** Returns the exposure time [s] that a keyword records; 0 for a bias frame. NaN: none. Other programs write words
 * there, so that no value is an error. */
double
ExposureIn(const FitsHeader & header, const std::string & key)
{
  const double seconds = FortranNumber(header.Text(key)).value_or(-1.0);
  return seconds >= 0.0 ? seconds : std::numeric_limits<double>::quiet_NaN();
}

/** Sets camera, Bayer pattern and exposure time [s]. The pattern is set only if ROWORDER says that rows are stored from
 * the top and if its offsets are 0. */
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
    const double seconds = ExposureIn(header, key);
    if (std::isfinite(seconds) && !(camera.exposureSeconds > 0.0))
    {
      camera.exposureSeconds = seconds;
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
