// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EmvaText.h"

#include "sensornoise/Emva1288.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Version.h"
#include "report/ReportParts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

namespace sensornoise
{

const std::vector<EmvaQuantityEntry> &
EmvaQuantityList()
{
  using Of = EmvaReport;
  static const std::vector<EmvaQuantityEntry> entries{
    { "sensitivity", "gain", "K", "system gain", "DN/e-", "(50)", &Of::gain },
    { "sensitivity", "weighted_gain", "", "weighted gain", "DN/e-", "", &Of::weightedGain },
    { "sensitivity", "weighted_intercept", "", "weighted intercept", "DN^2", "", &Of::weightedIntercept },
    { "sensitivity", "weighted_reduced_chi2", "", "weighted reduced chi2", "1", "", &Of::weightedReducedChi2 },
    { "sensitivity", "responsivity", "R", "responsivity", "DN/photon", "(49)", &Of::responsivity },
    { "sensitivity", "quantum_efficiency", "η", "quantum efficiency", "%", "(52)", &Of::quantumEfficiency },
    { "sensitivity", "dark_signal", "μ_y.dark", "dark signal", "DN", "(16)", &Of::darkSignal },
    { "sensitivity", "dark_noise_dn", "σ_y.dark", "dark noise", "DN", "(18)", &Of::darkNoise },
    { "sensitivity", "dark_noise", "σ_d", "dark noise", "e-", "(53)", &Of::darkNoiseElectrons },
    { "sensitivity", "saturation_dn", "μ_y.sat - μ_y.dark", "saturation", "DN", "6.6", &Of::saturationSignal },
    { "sensitivity", "saturation_photons", "μ_p.sat", "saturation capacity", "photon", "6.6", &Of::saturationPhotons },
    { "sensitivity", "saturation_electrons", "μ_e.sat", "saturation capacity", "e-", "6.6", &Of::saturationElectrons },
    { "sensitivity", "threshold_photons", "μ_p.min", "sensitivity threshold", "photon", "(26)", &Of::thresholdPhotons },
    { "sensitivity", "threshold_electrons", "μ_e.min", "sensitivity threshold", "e-", "(26)", &Of::thresholdElectrons },
    { "sensitivity", "snr_max", "SNR_max", "maximum SNR", "1", "(55)", &Of::largestSnr },
    { "sensitivity", "dynamic_range", "DR", "dynamic range", "1", "(28)", &Of::dynamicRange },
    { "linearity", "linearity_error", "LE", "linearity error", "%", "(63)", &Of::linearityError },
    { "linearity", "linearity_error_without_noise", "", "error without noise", "%", "", &Of::linearityErrorCorrected },
    { "linearity", "lowest_deviation", "", "lowest deviation", "%", "(62)", &Of::lowestDeviation },
    { "linearity", "highest_deviation", "", "highest deviation", "%", "(62)", &Of::highestDeviation },
    { "linearity", "slope", "a_1", "slope of the line", "DN/unit", "(60)", &Of::linearitySlope },
    { "linearity", "offset", "a_0", "offset of the line", "DN", "(59)", &Of::linearityOffset },
    { "dark_current", "dark_current_dn", "μ_I.y", "dark current, mean", "DN/unit", "7.1", &Of::darkCurrent },
    { "dark_current", "dark_current", "μ_I.e", "dark current, mean", "e-/unit", "7.1", &Of::darkCurrentElectrons },
    { "dark_current",
      "dark_current_of_variance",
      "μ_I.e",
      "dark current, variance",
      "e-/unit",
      "7.1",
      &Of::darkCurrentOfVariance },
    { "spatial", "dsnu", "DSNU_1288", "DSNU", "e-", "(66)", &Of::dsnu },
    { "spatial", "dsnu_column", "DSNU_1288.col", "DSNU, columns", "e-", "(66)", &Of::dsnuColumn },
    { "spatial", "dsnu_row", "DSNU_1288.row", "DSNU, rows", "e-", "(66)", &Of::dsnuRow },
    { "spatial", "dsnu_pixel", "DSNU_1288.pixel", "DSNU, pixels", "e-", "(66)", &Of::dsnuPixel },
    { "spatial", "prnu", "PRNU_1288", "PRNU", "%", "(67)", &Of::prnu },
    { "spatial", "prnu_column", "PRNU_1288.col", "PRNU, columns", "%", "(67)", &Of::prnuColumn },
    { "spatial", "prnu_row", "PRNU_1288.row", "PRNU, rows", "%", "(67)", &Of::prnuRow },
    { "spatial", "prnu_pixel", "PRNU_1288.pixel", "PRNU, pixels", "%", "(67)", &Of::prnuPixel },
    { "comparison", "gain_through_origin", "", "gain, no offset", "DN/e-", "", &Of::gainThroughOrigin },
    { "comparison", "dsnu_unfiltered", "", "DSNU, unfiltered", "e-", "", &Of::dsnuUnfiltered },
    { "comparison", "prnu_unfiltered", "", "PRNU, unfiltered", "%", "", &Of::prnuUnfiltered },
  };
  return entries;
}

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

namespace
{
/** Returns the texts of all planes, one after the other: textOf(name of the plane, its report). */
template <typename TFunction>
std::string
OfPlanes(const EmvaMosaicReport & report, TFunction textOf)
{
  std::string text;
  for (std::size_t i = 0; i < BayerPlanes.size(); ++i)
  {
    text += textOf(std::string(NameOf(BayerPlanes[i])), report.planes[i]);
  }
  return text;
}
} // namespace

std::string
MakeTable(const EmvaMosaicReport & report)
{
  return OfPlanes(report, [](const std::string & name, const EmvaReport & plane) {
    return (name == "R" ? "" : "\n") + ("Plane " + name + "\n") + MakeTable(plane);
  });
}

std::string
ToJson(const EmvaMosaicReport & report)
{
  const std::string planes = OfPlanes(report, [](const std::string & name, const EmvaReport & plane) {
    std::string record = ToJson(plane);
    record.erase(record.find_last_not_of('\n') + 1);
    return (name == "R" ? "" : ",") + ("\n\"" + name + "\": " + record);
  });
  return std::string("{\"schema\": \"") + EmvaMosaicSchema + "\", \"version\": \"" + GetModuleVersion() +
         "\", \"bayer\": \"" + NameOf(report.pattern) + "\", \"planes\": {" + planes + "}}\n";
}

std::string
ToXml(const EmvaMosaicReport & report)
{
  return std::string("<mosaic pattern=\"") + NameOf(report.pattern) + "\">\n" +
         OfPlanes(report,
                  [](const std::string & name, const EmvaReport & plane) {
                    return "<plane name=\"" + name + "\">\n" + ToXml(plane) + "</plane>\n";
                  }) +
         "</mosaic>\n";
}

std::string
ToSvg(const EmvaMosaicReport & report)
{
  return ToSvg(report.planes[1]);
}

} // namespace sensornoise
