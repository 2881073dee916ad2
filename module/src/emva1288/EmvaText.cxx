// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EmvaText.h"

#include "report/ReportTable.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace sensornoise
{

namespace
{
/** Returns a ratio in decibels and bits as one line; "": there is no value. */
std::string
DescribeDecibels(const char * name, const Quantity & quantity)
{
  if (!quantity.value)
  {
    return "";
  }
  char text[128];
  std::snprintf(text,
                sizeof(text),
                "%s: %.2f dB, %.2f bit\n",
                name,
                20.0 * std::log10(*quantity.value),
                std::log2(*quantity.value));
  return text;
}
} // namespace

std::string
EmvaSectionTitle(const std::string & section)
{
  return section == "sensitivity"    ? "Sensitivity"
         : section == "linearity"    ? "Linearity"
         : section == "dark_current" ? "Dark current"
         : section == "spatial"      ? "Non-uniformity, after the highpass filter"
                                     : "For comparison";
}

std::string
EmvaSeriesWords(const EmvaReport & report)
{
  std::size_t frames = 0;
  for (const EmvaSeries & series : report.series)
  {
    frames += series.frames;
  }
  const auto dark = static_cast<std::size_t>(
    std::count_if(report.series.begin(), report.series.end(), [](const EmvaSeries & series) { return series.isDark; }));
  return std::to_string(frames) + " frames of " + std::to_string(report.width) + " x " + std::to_string(report.height) +
         " pixels: " + std::to_string(report.series.size() - dark) + " series of flat fields, " + std::to_string(dark) +
         " of dark frames";
}

bool
HasPhotons(const EmvaReport & report)
{
  return std::all_of(
    report.points.begin(), report.points.end(), [](const EmvaPoint & point) { return point.photons.has_value(); });
}

std::string
UnitOf(const EmvaQuantityEntry & entry, const EmvaReport & report)
{
  std::string       unit = entry.unit;
  const std::string word = "unit";
  const auto        at = unit.find(word);
  const bool        isOfPhotons = std::strcmp(entry.section, "linearity") == 0 && HasPhotons(report);
  if (at != std::string::npos && isOfPhotons)
  {
    unit.replace(at, word.size(), "photon");
  }
  else if (at != std::string::npos && !report.settings.exposureUnit.empty())
  {
    unit.replace(at, word.size(), report.settings.exposureUnit);
  }
  return unit;
}

std::string
MakeTable(const EmvaReport & report)
{
  std::string table = EmvaSeriesWords(report) + "\nmethod: emva1288 (EMVA Standard 1288, Release 4.0 Linear)\n";
  std::string section;
  for (const EmvaQuantityEntry & entry : EmvaQuantityList())
  {
    if (section != entry.section)
    {
      section = entry.section;
      table += "\n" + EmvaSectionTitle(section) + "\n";
    }
    table += QuantityLine(entry.label, UnitOf(entry, report), report.*entry.quantity, true);
  }
  const std::string decibels =
    DescribeDecibels("maximum SNR", report.largestSnr) + DescribeDecibels("dynamic range", report.dynamicRange);
  table += decibels.empty() ? "" : "\n" + decibels;
  const auto inFit = std::count_if(
    report.points.begin(), report.points.end(), [](const EmvaPoint & point) { return point.isInGainFit; });
  table += "\ngain: " + std::to_string(inFit) + " of " + std::to_string(report.points.size()) +
           " exposures in the range of 0 to 70 % of saturation\n";
  for (const EmvaNote & note : report.notes)
  {
    table += "note: " + note.message + " [" + note.code + "]\n";
  }
  return table;
}

} // namespace sensornoise
