// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackReport.h"

#include "base/Text.h"
#include "files/Zlib.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>

namespace sensornoise
{

void
RequireSelection(const StackSelection & selection, const FrameGeometry & geometry, std::size_t frames)
{
  const auto text = [](std::size_t number) { return std::to_string(number); };
  if (const auto & roi = selection.roi; roi && ((*roi)[2] != geometry.width || (*roi)[3] != geometry.height))
  {
    throw std::invalid_argument("the source's region has " + text((*roi)[2]) + " x " + text((*roi)[3]) +
                                " pixels, but the frames have " + text(geometry.width) + " x " + text(geometry.height));
  }
  if (const auto & range = selection.frames; range && range->second != range->first + frames)
  {
    throw std::invalid_argument("the source's frames are " + text(range->first) + " up to " + text(range->second) +
                                ", but the stack has " + text(frames));
  }
}

InputFiles
InputFilesOf(const std::string & sha256, std::size_t files, std::uint64_t bytes)
{
  const bool hasOnlyDigits = sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!sha256.empty() && (sha256.size() != 64 || !hasOnlyDigits))
  {
    throw std::invalid_argument("the hash is \"" + sha256 +
                                "\"; expected a SHA-256, 64 hexadecimal digits in small letters");
  }
  return { sha256, files, bytes };
}

void
NoteDnSettings(Report & report, const DnSettings & dnSettings)
{
  const auto note = [&report](const char * name, const auto & given) {
    if (given)
    {
      report.settings.emplace_back(name, static_cast<double>(*given));
    }
  };
  note("bit_depth", dnSettings.bitDepth);
  note("clip_low", dnSettings.clipLowDn);
  note("clip_high", dnSettings.clipHighDn);
  note("quantisation_step", dnSettings.quantisationStepDn);
}

void
NoteMask(Report & report, const FrameGeometry & geometry, const std::vector<std::uint8_t> & mask)
{
  if (mask.empty())
  {
    return;
  }
  const std::string shape = std::to_string(geometry.width) + "x" + std::to_string(geometry.height) + ":";
  uLong sum = crc32(0, reinterpret_cast<const unsigned char *>(shape.data()), static_cast<uInt>(shape.size()));
  std::vector<unsigned char> row(geometry.width);
  for (std::size_t y = 0; y < geometry.height; ++y)
  {
    const auto first = mask.begin() + static_cast<std::ptrdiff_t>(y * geometry.width);
    std::transform(first, first + static_cast<std::ptrdiff_t>(geometry.width), row.begin(), [](std::uint8_t value) {
      return static_cast<unsigned char>(value != 0);
    });
    sum = crc32(sum, row.data(), static_cast<uInt>(row.size()));
  }
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08lx", sum & 0xffffffffUL);
  report.settings.emplace_back("mask_crc32", std::string(text.data()));
}

void
NoteSelection(Report & report, const StackSelection & selection)
{
  const auto note = [&report](const char * name, std::size_t number) {
    report.settings.emplace_back(name, static_cast<double>(number));
  };
  if (const auto & roi = selection.roi)
  {
    note("roi_x", (*roi)[0]);
    note("roi_y", (*roi)[1]);
    note("roi_width", (*roi)[2]);
    note("roi_height", (*roi)[3]);
  }
  if (const auto & frames = selection.frames)
  {
    note("frame_range_first", frames->first);
    note("frame_range_end", frames->second);
  }
}

namespace
{
/** Multiplies a value, if there is one, both bounds of an interval, or all numbers of a quantity by \a factor. */
void
Multiply(std::optional<double> & number, double factor)
{
  if (number)
  {
    *number *= factor;
  }
}

void
Multiply(std::optional<Interval> & interval, double factor)
{
  if (interval)
  {
    Multiply(interval->low, factor);
    Multiply(interval->high, factor);
  }
}

void
Multiply(Quantity & quantity, double factor)
{
  Multiply(quantity.value, factor);
  Multiply(quantity.standardError, factor);
  Multiply(quantity.interval95, factor);
  Multiply(quantity.bracket, factor);
}
} // namespace

void
ValidateExcessNoiseFactor(double factor)
{
  if (!(factor >= 1.0 && std::isfinite(factor)))
  {
    throw std::invalid_argument("the excess noise factor is " + Text(factor) +
                                "; expected a number of 1 or more, 2 for an EMCCD");
  }
}

void
ValidateLevelRange(const LevelRange & range)
{
  if (!(range.lowDn < range.highDn && std::isfinite(range.lowDn) && std::isfinite(range.highDn)))
  {
    throw std::invalid_argument("the range of levels is from " + Text(range.lowDn) + " to " + Text(range.highDn) +
                                " DN; expected the lower level first, both finite");
  }
}

void
ValidateShutterRows(double rows)
{
  if (!(rows > 0.0 && rows <= 1e5))
  {
    throw std::invalid_argument("sigma_y of the rolling shutter is " + Text(rows) +
                                " rows; expected a positive number, at most 100000");
  }
}

std::string
ReasonUnused(const std::string & method, const std::string & setting)
{
  const bool isPublished = method == "published";
  const bool isSingleImage = method == "single-image";
  if (setting == "offset" || setting == "dark")
  {
    return isPublished     ? "finds the offset from the flicker alone"
           : isSingleImage ? "measures slope and intercept of the variance and uses no offset"
                           : "";
  }
  if (setting == "level_range")
  {
    return isPublished || isSingleImage ? "fits all levels" : "";
  }
  if (setting == "exposures")
  {
    return isPublished || isSingleImage ? "does not measure the linearity" : "";
  }
  if (setting == "maps")
  {
    return isSingleImage ? "has no maps over time" : "";
  }
  throw std::invalid_argument("the setting is \"" + setting +
                              "\"; expected offset, dark, level_range, exposures or maps");
}

void
RequireUsed(const std::string & method, const std::string & setting, const std::string & words)
{
  if (const std::string reason = ReasonUnused(method, setting); !reason.empty())
  {
    throw std::invalid_argument(words + " cannot be used by the method " + method + ", which " + reason +
                                ": leave out what was given, or set the method to refined");
  }
}

void
DivideExcessNoise(Report & report, double factor)
{
  if (factor == 1.0)
  {
    return;
  }
  report.settings.emplace_back("excess_noise_factor", factor);
  Multiply(report.gain, 1.0 / factor);
  Multiply(report.readNoiseElectrons, factor);
  for (GainByPartsRecord & record : report.gainByParts)
  {
    for (GainByPartsRecord::Part & part : record.parts)
    {
      part.gain /= factor;
      part.standardError /= factor;
    }
  }
  if (report.covariance)
  {
    auto & covariance = *report.covariance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      covariance[0][k] /= factor;
      covariance[k][0] /= factor;
    }
  }
}

} // namespace sensornoise
