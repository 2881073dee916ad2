// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PackedFrames.h"

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameSizes.h"
#include "files/StoredNumber.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr std::size_t BlockBytes = std::size_t{ 1 } << 20;

/** Pixels that follow each other without a gap. */
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

/** Rows with a gap behind each. */
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

/** The bytes of a frame. Throws FileError. */
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
                    std::to_string(file.width) + " x " + std::to_string(file.height) + " pixels, of which " +
                      std::to_string(group) + " are packed in " + std::to_string(BytesInGroup(format)) +
                      " bytes; expected " + (hasGaps ? "a width" : "a number of pixels") + " that is a multiple of " +
                      std::to_string(group));
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

std::optional<std::uint64_t>
CheckedSum(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t largest = INT64_MAX;
  return a > largest || b > largest - a ? std::nullopt : std::optional<std::uint64_t>(a + b);
}

/** In words, behind those of a frame's own bytes. */
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
  // the last frame may have nothing behind it
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
