// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/DngDirectory.h"
#include "exports/ExportFormats.h"

#include "files/FileBytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
// DNG 1.7, tag NoiseProfile. New directories and values stand at the end of the file: no byte that another tag points
// to moves.

using NoisePairs = std::vector<std::pair<double, double>>;

constexpr std::uint64_t noiseProfileTag = 51041;
constexpr std::uint64_t doubleType = 12;

/** Appends a directory with the tag NoiseProfile to a file, and sets its offset, which is at \a pointer. A tag that is
 * there is replaced. \a values: place of the pairs in the file. */
void
AppendDirectory(std::string & file, TagDirectory directory, std::size_t pointer, std::size_t values, std::size_t pairs)
{
  const bool isBigEndian = TagFile(file).IsBigEndian();
  const auto bytesOf = [isBigEndian](std::uint64_t number, std::size_t bytes) {
    return BytesOfNumber(number, bytes, isBigEndian);
  };
  auto & entries = directory.entries;
  entries.erase(
    std::remove_if(entries.begin(), entries.end(), [](const TagEntry & each) { return each.tag == noiseProfileTag; }),
    entries.end());
  const std::string bytes = bytesOf(noiseProfileTag, 2) + bytesOf(doubleType, 2) + bytesOf(2 * pairs, 4) +
                            bytesOf(values, TagFile::PointerBytes);
  entries.push_back({ noiseProfileTag, doubleType, 2 * pairs, 0, bytes });
  std::stable_sort(entries.begin(), entries.end(), [](const auto & a, const auto & b) { return a.tag < b.tag; });
  const std::size_t begin = file.size();
  file += bytesOf(entries.size(), 2);
  for (const TagEntry & entry : entries)
  {
    file += entry.bytes;
  }
  file += bytesOf(directory.next, TagFile::PointerBytes);
  if (file.size() > std::numeric_limits<std::uint32_t>::max() ||
      entries.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw ExportError("the file has " + std::to_string(begin) + " bytes and " + std::to_string(entries.size()) +
                      " tags; a TIFF file has at most 4 GiB and 65535 tags");
  }
  file.replace(pointer, TagFile::PointerBytes, bytesOf(begin, TagFile::PointerBytes));
}

/** Returns the pairs of a tag NoiseProfile. */
NoisePairs
PairsOf(const TagFile & tiff, const TagEntry & entry, const char * directory)
{
  constexpr std::size_t numberBytes = sizeof(double);
  constexpr std::size_t mostPlanes = 4;
  if (entry.type != doubleType || entry.count < 2 || entry.count % 2 != 0 || entry.count > 2 * mostPlanes)
  {
    throw ExportError("the tag NoiseProfile has " + std::to_string(entry.count) + " numbers of TIFF's type " +
                      std::to_string(entry.type) + "; expected pairs of DOUBLE (12), at most " +
                      std::to_string(mostPlanes));
  }
  const auto values = static_cast<std::size_t>(tiff.NumberAt(entry.valuePlace, TagFile::PointerBytes, directory));
  const auto number = [&](std::size_t i) {
    return RealOfBits(tiff.NumberAt(values + i * numberBytes, numberBytes, directory));
  };
  NoisePairs profile;
  for (std::size_t i = 0; i < entry.count; i += 2)
  {
    profile.emplace_back(number(i), number(i + 1));
  }
  return profile;
}
} // namespace

std::string
WithNoiseProfile(const std::string & file, const NoisePairs & profile)
{
  const TagFile     tiff(file);
  const auto        raw = tiff.FindRawPointer(tiff.ReadDirectory(TagFile::FirstPointer, "first"));
  std::string       copy = file + std::string(file.size() % 2, '\0'); // values begin at even offsets
  const std::size_t values = copy.size();
  for (const auto & [scale, offset] : profile)
  {
    copy += BytesOfReal(scale, tiff.IsBigEndian()) + BytesOfReal(offset, tiff.IsBigEndian());
  }
  if (raw)
  {
    AppendDirectory(copy, tiff.ReadDirectory(*raw, "raw"), *raw, values, profile.size());
  }
  // Read from the copy: the offset of the raw directory may stand in its entry.
  AppendDirectory(
    copy, TagFile(copy).ReadDirectory(TagFile::FirstPointer, "first"), TagFile::FirstPointer, values, profile.size());
  return copy;
}

NoisePairs
NoiseProfileIn(const std::string & file)
{
  const TagFile      tiff(file);
  const TagDirectory first = tiff.ReadDirectory(TagFile::FirstPointer, "first");
  if (const TagEntry * const found = first.Find(noiseProfileTag))
  {
    return PairsOf(tiff, *found, "first");
  }
  if (const auto pointer = tiff.FindRawPointer(first))
  {
    const TagDirectory raw = tiff.ReadDirectory(*pointer, "raw");
    if (const TagEntry * const found = raw.Find(noiseProfileTag))
    {
      return PairsOf(tiff, *found, "raw");
    }
  }
  throw ExportError("the file has no tag NoiseProfile (51041) in its first directory, nor in its raw directory "
                    "(SubIFDs), where DNG files have it");
}

} // namespace sensornoise
