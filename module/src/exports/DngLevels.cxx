// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/DngDirectory.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
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
