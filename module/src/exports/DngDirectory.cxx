// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/DngDirectory.h"

#include "base/Text.h"
#include "exports/ExportFormats.h"
#include "files/FileBytes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
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

namespace
{
// DNG 1.7: BlackLevel and WhiteLevel are tags of the raw directory, one number or one for each place of a pattern and
// each sample. Without them the black level is 0, and the white level is the largest integer of BitsPerSample, or 1.0
// for floating-point numbers (SampleFormat 3).
constexpr std::uint64_t bitsTag = 258;
constexpr std::uint64_t sampleFormatTag = 339;
constexpr std::uint64_t versionTag = 50706;
constexpr std::uint64_t blackLevelTag = 50714;
constexpr std::uint64_t whiteLevelTag = 50717;

/** Returns the numbers of a tag: SHORT, LONG or RATIONAL. Empty: the directory does not have it. */
std::vector<double>
NumbersOfTag(const TagFile & tiff, const TagDirectory & directory, std::uint64_t tag)
{
  const TagEntry * const entry = directory.Find(tag);
  if (entry == nullptr)
  {
    return {};
  }
  constexpr std::uint64_t longType = 4;
  constexpr std::uint64_t rationalType = 5;
  constexpr std::size_t   mostNumbers = 4096; // far more than the places of a pattern
  const std::size_t       bytes = entry->type == TagFile::ShortType ? 2
                                  : entry->type == longType         ? 4
                                  : entry->type == rationalType     ? 8
                                                                    : 0;
  if (bytes == 0 || entry->count < 1 || entry->count > mostNumbers)
  {
    throw ExportError("the tag " + std::to_string(tag) + " has " + std::to_string(entry->count) +
                      " numbers of TIFF's type " + std::to_string(entry->type) +
                      "; expected SHORT (3), LONG (4) or RATIONAL (5), as in a DNG file");
  }
  const auto number = [&](std::size_t place, std::size_t width) {
    return static_cast<double>(tiff.NumberAt(place, width, "raw"));
  };
  const bool        isInside = bytes * entry->count <= TagFile::PointerBytes;
  const std::size_t first =
    isInside ? entry->valuePlace
             : static_cast<std::size_t>(tiff.NumberAt(entry->valuePlace, TagFile::PointerBytes, "raw"));
  std::vector<double> numbers;
  for (std::size_t place = first; numbers.size() < entry->count; place += bytes)
  {
    numbers.push_back(bytes == 8 ? number(place, 4) / number(place + 4, 4) : number(place, bytes));
    if (!std::isfinite(numbers.back()))
    {
      throw ExportError("the tag " + std::to_string(tag) + " has a denominator of 0; expected levels in DN");
    }
  }
  return numbers;
}

std::vector<double>
WhiteLevelsOf(const TagFile & tiff, const TagDirectory & raw)
{
  std::vector<double> levels = NumbersOfTag(tiff, raw, whiteLevelTag);
  if (levels.empty())
  {
    const auto bits = NumbersOfTag(tiff, raw, bitsTag);
    const auto format = NumbersOfTag(tiff, raw, sampleFormatTag);
    const bool isFloat = !format.empty() && format.front() == 3.0;
    levels.push_back(isFloat || bits.empty() ? 1.0 : std::exp2(bits.front()) - 1.0);
  }
  return levels;
}

/** Returns the mean of the levels of a file. Throws ExportUseError if another level is given. */
double
LevelOf(const std::vector<double> &   levels,
        const std::optional<double> & given,
        double                        tolerance,
        const std::string &           name,
        std::uint64_t                 tag)
{
  const auto [lowest, highest] = std::minmax_element(levels.begin(), levels.end());
  if (given && !(*given >= *lowest - tolerance && *given <= *highest + tolerance))
  {
    throw ExportUseError("the " + name + " level is " + Text(*given) + " DN (--" + name + "), and the DNG file has " +
                         Text(*lowest) + (*lowest < *highest ? " to " + Text(*highest) : "") + " DN (tag " +
                         std::to_string(tag) +
                         "), to which its NoiseProfile refers. Leave the level out, or give a DNG file of the camera "
                         "and setting of the report.");
  }
  return std::accumulate(levels.begin(), levels.end(), 0.0) / static_cast<double>(levels.size());
}
} // namespace

void
SetLevelsOfDng(const std::string & file, ExportSettings & settings)
{
  const TagFile      tiff(file);
  const TagDirectory first = tiff.ReadDirectory(TagFile::FirstPointer, "first");
  if (first.Find(versionTag) == nullptr)
  {
    throw ExportError("the file is a TIFF without the tag DNGVersion (50706); expected a DNG file, whose black and "
                      "white level NoiseProfile refers to");
  }
  const auto          pointer = tiff.FindRawPointer(first);
  const TagDirectory  raw = pointer ? tiff.ReadDirectory(*pointer, "raw") : first;
  std::vector<double> black = NumbersOfTag(tiff, raw, blackLevelTag);
  if (black.empty())
  {
    black.push_back(0.0);
  }
  const std::vector<double> white = WhiteLevelsOf(tiff, raw);
  constexpr double          rounding = 0.5;     // levels of a file may be rounded [DN]
  constexpr double          roundedPart = 1e-3; // largest rounding of levels from 0 to 1, over their range
  const double              tolerance = std::min(rounding, roundedPart * std::abs(white.front() - black.front()));
  settings.blackLevelDn = LevelOf(black, settings.blackLevelDn, tolerance, "black", blackLevelTag);
  settings.whiteLevelDn = LevelOf(white, settings.whiteLevelDn, tolerance, "white", whiteLevelTag);
}

} // namespace sensornoise
