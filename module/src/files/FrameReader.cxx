// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"

#include "files/FileBytes.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

namespace sensornoise
{
namespace
{
/** Calls \a unpack for the bytes and pixels of each group. */
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

namespace
{
constexpr std::size_t BlockBytes = std::size_t{ 1 } << 20;

/** Reads \a samples pixels that follow each other without a gap. */
void
ReadRun(FileBytes & bytes, const SampleFormat & format, std::uint64_t offset, std::size_t samples, char * pixels)
{
  if (format.packing == SamplePacking::Whole)
  {
    bytes.Read(offset, pixels, samples * BytesInGroup(format));
    ToOwnByteOrder(format.isBigEndian, BytesInGroup(format), samples, pixels);
    ConvertStored(format.stored, samples, pixels);
    return;
  }
  const std::size_t          bytesInGroup = BytesInGroup(format);
  const std::size_t          groups = samples / SamplesInGroup(format);
  const std::size_t          block = std::min(groups, BlockBytes / bytesInGroup);
  std::vector<unsigned char> packed(block * bytesInGroup);
  for (std::size_t done = 0; done < groups; done += block)
  {
    const std::size_t now = std::min(block, groups - done);
    bytes.Read(offset + done * bytesInGroup, packed.data(), now * bytesInGroup);
    UnpackSamples(format, packed.data(), now, pixels + done * SamplesInGroup(format) * SizeOf(format.pixel));
  }
}

/** Reads the rows of a frame, with a gap behind each row. */
void
ReadRows(FileBytes & bytes, const FramePlaces & places, std::uint64_t offset, const FrameFile & file, char * pixels)
{
  const auto                 rowBytes = static_cast<std::size_t>(places.rowBytes);
  const std::size_t          rows = std::min(file.height, std::max<std::size_t>(1, BlockBytes / rowBytes));
  const std::size_t          groups = file.width / SamplesInGroup(places.sample);
  std::vector<unsigned char> packed(rows * rowBytes);
  for (std::size_t row = 0; row < file.height; row += rows)
  {
    const std::size_t now = std::min(rows, file.height - row);
    bytes.Read(offset + row * rowBytes, packed.data(), now * rowBytes);
    for (std::size_t i = 0; i < now; ++i)
    {
      UnpackSamples(
        places.sample, packed.data() + i * rowBytes, groups, pixels + (row + i) * file.width * SizeOf(file.pixel));
    }
  }
}

/** Returns the size of a frame [bytes]. Throws FileError if its pixels do not fill whole groups, or if a row has more
 * bytes than places.rowBytes. */
std::uint64_t
BytesOfFrame(const FrameFile & file, const FramePlaces & places)
{
  const SampleFormat &               format = places.sample;
  const bool                         hasGaps = places.rowBytes != 0;
  const std::optional<std::uint64_t> row = PackedBytes(format, file.width);
  const std::optional<std::uint64_t> bytes = hasGaps ? CheckedProduct(places.rowBytes, file.height)
                                                     : PackedBytes(format, std::uint64_t{ file.width } * file.height);
  if (!bytes || (hasGaps && !row))
  {
    const std::size_t group = SamplesInGroup(format);
    throw FileError(file.name,
                    std::to_string(file.width) + " x " + std::to_string(file.height) + " pixels, packed " +
                      std::to_string(group) + " in " + std::to_string(BytesInGroup(format)) + " bytes; expected " +
                      (hasGaps ? "a width" : "a number of pixels") + " that is a multiple of " + std::to_string(group));
  }
  if (hasGaps && places.rowBytes < *row)
  {
    throw FileError(file.name,
                    std::to_string(places.rowBytes) + " bytes from a row to the next, but a row of " +
                      std::to_string(file.width) + " pixels has " + std::to_string(*row) +
                      "; expected at least as many");
  }
  return *bytes;
}

/** Returns a + b; none if it exceeds INT64_MAX. */
std::optional<std::uint64_t>
CheckedSum(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t largest = INT64_MAX;
  return a > largest || b > largest - a ? std::nullopt : std::optional<std::uint64_t>(a + b);
}

/** Returns the bytes behind the frames in words, to follow the size of a frame in a message. */
std::string
BytesBesideFrames(const FramePlaces & places)
{
  return (places.gapBytes == 0 ? "" : ", " + std::to_string(places.gapBytes) + " behind each") +
         (places.endBytes == 0 ? "" : ", " + std::to_string(places.endBytes) + " behind the last");
}
} // namespace

std::optional<std::uint64_t>
PackedBytes(const SampleFormat & format, std::uint64_t samples)
{
  if (samples % SamplesInGroup(format) != 0)
  {
    return std::nullopt;
  }
  return CheckedProduct(samples / SamplesInGroup(format), BytesInGroup(format));
}

void
SetFramePlaces(FrameFile &                  file,
               FramePlaces                  places,
               std::uint64_t                fileBytes,
               std::optional<std::uint64_t> frames,
               std::uint64_t                trailerBytes)
{
  const std::uint64_t frameBytes = BytesOfFrame(file, places);
  places.frameBytes = CheckedSum(frameBytes, places.gapBytes).value_or(INT64_MAX);
  const std::uint64_t found = fileBytes - std::min(fileBytes, places.offset);
  const std::string   held =
    std::to_string(found) + " bytes of pixels" + (places.path == file.name ? "" : " in its data file " + places.path);
  const std::string frame = std::to_string(frameBytes) + " bytes a frame of " + std::to_string(file.width) + " x " +
                            std::to_string(file.height) + " pixels" + BytesBesideFrames(places);
  const std::uint64_t inFrames = found - std::min(found, places.endBytes);
  const std::uint64_t number = frames.value_or((inFrames + places.gapBytes) / places.frameBytes);
  const std::uint64_t rest = inFrames - std::min(inFrames, number * places.frameBytes);
  const bool          isWhole = number > 0 && ((inFrames + places.gapBytes) % places.frameBytes == 0 || rest == 0);
  if (!frames && (!isWhole || found < places.endBytes))
  {
    throw FileError(
      file.name,
      held + ", at " + frame + " " + std::to_string(number) + " frames and " + std::to_string(rest) +
        " bytes more; expected a whole number of frames, or in the layout the bytes behind each (GAP) or at the "
        "end of the file (END): WIDTHxHEIGHT:TYPE:SKIP:ROW:GAP:END");
  }
  const std::optional<std::uint64_t> all = CheckedProduct(places.frameBytes, number);
  const std::optional<std::uint64_t> trailer = CheckedProduct(trailerBytes, number);
  // the gap behind the last frame may be missing
  const std::uint64_t least = all ? *all - std::min(*all, places.gapBytes) : 0;
  if (!all || inFrames < least || (inFrames != least && inFrames != *all && inFrames - least != trailer))
  {
    throw FileError(
      file.name,
      std::string(!all || inFrames < least ? "truncated: " : "") + held + "; expected " +
        (all ? std::to_string(least) : "more than can be counted") + ", " + frame +
        ", frames: " + std::to_string(number) +
        (trailerBytes == 0 ? "" : ", and " + std::to_string(trailerBytes) + " bytes more for each or none"));
  }
  file.pixel = places.sample.pixel;
  file.stored = places.sample.stored;
  SetFrameSizes(file, { file.width, file.height, number });
  file.reader = std::make_shared<PackedFrames>(std::move(places));
}

void
PackedFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  FileBytes         bytes(file.name, m_Places.path);
  const std::size_t pixels = file.width * file.height;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t offset = m_Places.offset + (first + i) * m_Places.frameBytes;
    char * const        frame = static_cast<char *>(buffer) + i * pixels * SizeOf(file.pixel);
    if (m_Places.rowBytes == 0)
    {
      ReadRun(bytes, m_Places.sample, offset, pixels, frame);
    }
    else
    {
      ReadRows(bytes, m_Places, offset, file, frame);
    }
  }
}

} // namespace sensornoise
