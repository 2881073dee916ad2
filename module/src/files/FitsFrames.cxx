// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FitsFrames.h"

#include "files/FileBytes.h"
#include "files/SamplePacking.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace sensornoise
{
namespace
{
/** Values of numbers, which are in this machine's byte order. */
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
} // namespace

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

void
FitsFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  constexpr std::size_t      block = std::size_t{ 1 } << 17; // pixels at a time: a MiB of double
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

} // namespace sensornoise
