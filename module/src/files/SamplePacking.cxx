// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/SamplePacking.h"

#include "files/ByteOrder.h"
#include "files/StoredNumber.h"

#include <algorithm>
#include <cstring>

namespace sensornoise
{
namespace
{
/** The pixels of a group, from its bytes as a number, lowest byte first. */
template <typename TUnpack>
void
UnpackGroups(const SampleFormat &  format,
             const unsigned char * bytes,
             std::size_t           groups,
             unsigned short *      pixels,
             TUnpack               unpack)
{
  const std::size_t bytesInGroup = BytesInGroup(format);
  const std::size_t samples = SamplesInGroup(format);
  for (std::size_t group = 0; group < groups; ++group)
  {
    unpack(bytes, pixels);
    bytes += bytesInGroup;
    pixels += samples;
  }
}

bool
IsHostBigEndian()
{
  const std::uint16_t one = 1;
  unsigned char       first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}
} // namespace

SampleFormat
WholeSample(const FrameFile & file, bool isBigEndian)
{
  SampleFormat format;
  format.pixel = file.pixel;
  format.stored = file.stored;
  format.bits = static_cast<unsigned>(8 * SizeOf(file.pixel, file.stored));
  format.isBigEndian = isBigEndian;
  return format;
}

std::size_t
SamplesInGroup(const SampleFormat & format)
{
  if (format.packing == SamplePacking::Whole)
  {
    return 1;
  }
  return format.packing == SamplePacking::GigE || format.bits == 12 ? 2 : 4;
}

std::size_t
BytesInGroup(const SampleFormat & format)
{
  if (format.packing == SamplePacking::Whole)
  {
    return SizeOf(format.pixel, format.stored);
  }
  return format.packing == SamplePacking::GigE ? 3 : SamplesInGroup(format) * format.bits / 8;
}

void
ToOwnByteOrder(bool isBigEndian, std::size_t bytesOfPixel, std::size_t count, void * pixels)
{
  if (isBigEndian == IsHostBigEndian() || bytesOfPixel == 1)
  {
    return;
  }
  auto * const bytes = static_cast<unsigned char *>(pixels);
  for (std::size_t i = 0; i < count; ++i)
  {
    std::reverse(bytes + i * bytesOfPixel, bytes + (i + 1) * bytesOfPixel);
  }
}

void
UnpackSamples(const SampleFormat & format, const unsigned char * bytes, std::size_t groups, void * pixels)
{
  const std::size_t bytesInGroup = BytesInGroup(format);
  if (format.packing == SamplePacking::Whole)
  {
    std::memcpy(pixels, bytes, groups * bytesInGroup);
    ToOwnByteOrder(format.isBigEndian, bytesInGroup, groups, pixels);
    ConvertStored(format.stored, groups, pixels);
    return;
  }
  const std::size_t samples = SamplesInGroup(format);
  const unsigned    bits = format.bits;
  const unsigned    mask = (1U << bits) - 1;
  const unsigned    lowBits = bits > 8 ? bits - 8 : 0;
  const unsigned    lowMask = (1U << lowBits) - 1;
  auto * const      out = static_cast<unsigned short *>(pixels);
  switch (format.packing)
  {
    case SamplePacking::Whole:
      return;
    case SamplePacking::LowestFirst:
      UnpackGroups(format, bytes, groups, out, [=](const unsigned char * from, unsigned short * to) {
        const std::uint64_t number = NumberInBytes(from, bytesInGroup, false);
        for (std::size_t k = 0; k < samples; ++k)
        {
          to[k] = static_cast<unsigned short>((number >> (bits * k)) & mask);
        }
      });
      return;
    case SamplePacking::HighestFirst:
      UnpackGroups(format, bytes, groups, out, [=](const unsigned char * from, unsigned short * to) {
        const std::uint64_t number = NumberInBytes(from, bytesInGroup, true);
        for (std::size_t k = 0; k < samples; ++k)
        {
          to[k] = static_cast<unsigned short>((number >> (bits * (samples - 1 - k))) & mask);
        }
      });
      return;
    case SamplePacking::GigE:
      UnpackGroups(format, bytes, groups, out, [=](const unsigned char * from, unsigned short * to) {
        to[0] = static_cast<unsigned short>((from[0] << lowBits) | (from[1] & lowMask));
        to[1] = static_cast<unsigned short>((from[2] << lowBits) | ((from[1] >> 4) & lowMask));
      });
      return;
    case SamplePacking::Mipi:
      UnpackGroups(format, bytes, groups, out, [=](const unsigned char * from, unsigned short * to) {
        const std::uint64_t low = NumberInBytes(from + samples, bytesInGroup - samples, false);
        for (std::size_t k = 0; k < samples; ++k)
        {
          to[k] = static_cast<unsigned short>((from[k] << lowBits) | ((low >> (lowBits * k)) & lowMask));
        }
      });
      return;
  }
}

} // namespace sensornoise
