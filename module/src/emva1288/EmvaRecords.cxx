// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EmvaText.h"

#include "report/JsonWriter.h"
#include "report/ReportParts.h"
#include "sensornoise/Emva1288.h"
#include "sensornoise/Version.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Writes the spatial variances of a series as an object [DN^2]. */
void
WriteJson(JsonWriter & json, const EmvaSpatialVariance & variance)
{
  json.Object([&] {
    json.Member("columns", variance.columns)
      .Member("rows", variance.rows)
      .Member("measured", variance.measuredDn2)
      .Member("stack", variance.stackDn2)
      .Member("total", variance.totalDn2)
      .Member("column_mean", variance.columnMeanDn2)
      .Member("row_mean", variance.rowMeanDn2)
      .Member("column", variance.columnDn2)
      .Member("row", variance.rowDn2)
      .Member("pixel", variance.pixelDn2);
  });
}

/** Writes the statistics of a series as an object. */
void
WriteJson(JsonWriter & json, const EmvaSeries & series)
{
  json.Object([&] {
    json.Member("kind", series.isDark ? "dark" : "flat")
      .Member("exposure", series.exposure)
      .Member("photons", series.photons)
      .Member("frames", series.frames)
      .Member("mean", series.meanDn)
      .Member("temporal_variance", series.temporalVarianceDn2)
      .Member("highest", series.highestDn)
      .Member("fraction_at_highest", series.fractionAtHighest)
      .Member("spatial_variance", series.unfiltered)
      .Member("highpass_spatial_variance", series.highpass);
  });
}

/** Writes a point of the photon transfer curve as an object. */
void
WriteJson(JsonWriter & json, const EmvaPoint & point)
{
  json.Object([&] {
    json.Member("exposure", point.exposure)
      .Member("photons", point.photons)
      .Member("frames", point.frames)
      .Member("mean", point.meanDn)
      .Member("signal", point.signalDn)
      .Member("variance", point.varianceDn2)
      .Member("excess_variance", point.excessDn2)
      .Member("in_gain_fit", point.isInGainFit)
      .Member("deviation_percent", point.deviationPercent)
      .Member("snr", point.snr)
      .Member("model_snr", point.modelSnr)
      .Member("total_snr", point.totalSnr);
  });
}

/** Writes a remark as an object. */
void
WriteJson(JsonWriter & json, const EmvaNote & note)
{
  json.Object([&] { json.Member("code", note.code).Member("message", note.message); });
}

std::string
ToJson(const EmvaReport & report)
{
  std::string text;
  JsonWriter  json(text);
  const auto  writeSection = [&](const std::string & section) {
    for (const EmvaQuantityEntry & entry : EmvaQuantityList())
    {
      if (section == entry.section)
      {
        const std::string unit = UnitOf(entry, report);
        WriteQuantity(json, entry.name, report.*entry.quantity, unit.c_str());
      }
    }
  };
  json.Object([&] {
    json.Member("schema", EmvaSchema)
      .Member("version", GetModuleVersion())
      .Member("standard", "EMVA 1288 Release 4.0 Linear")
      .Member("width", report.width)
      .Member("height", report.height);
    json.ObjectMember("settings", [&] {
      json.Member("quantisation_step", report.settings.quantizationStepDn)
        .Member("bit_depth", report.settings.bitDepth)
        .Member("exposure_unit", report.settings.exposureUnit);
    });
    for (const char * const section : { "sensitivity", "linearity", "dark_current", "spatial", "comparison" })
    {
      json.ObjectMember(section, [&] { writeSection(section); });
    }
    json.Member("dark_series", report.darkStack)
      .Member("bright_series", report.brightStack)
      .Member("saturation_point", report.saturationPoint)
      .Member("points", report.points)
      .Member("series", report.series)
      .Member("notes", report.notes);
  });
  return text + "\n";
}

namespace
{
using Value = std::optional<double>;

/** Element of the XML: section and name as in the package emva1288, unit, and value. */
struct XmlEntry
{
  const char * section;
  std::string  name;
  const char * unit;
  Value        value;
};

std::string
NumberAsText(const Value & value)
{
  if (!value || !std::isfinite(*value))
  {
    return "nan"; // the package emva1288 writes an unknown number as nan
  }
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", *value);
  return text;
}

/** Returns function(value) of a known value; null: it is not known. */
template <typename TFunction>
Value
Map(const Value & value, TFunction function)
{
  return value ? Value(function(*value)) : std::nullopt;
}

Value
Decibels(const Value & value)
{
  return Map(value, [](double ratio) { return 20.0 * std::log10(ratio); });
}

/** Returns the variances of one series; of the highpass-filtered frames where there are such. */
EmvaSpatialVariance
VariancesOf(const EmvaReport & report, const std::optional<std::size_t> & series)
{
  const EmvaSeries & of = report.series[*series];
  return of.highpass.value_or(of.unfiltered);
}

void
AddSensitivity(const EmvaReport & report, std::vector<XmlEntry> & entries)
{
  const auto add = [&entries](const char * name, const char * unit, const Value & value) {
    entries.push_back({ "sensitivity", name, unit, value });
  };
  const Value & gain = report.gain.value;
  add("DR", "", report.dynamicRange.value);
  add("DR_dB", "", Decibels(report.dynamicRange.value));
  add("K", "$DN/e^-$", gain);
  add("QE", "\\%", report.quantumEfficiency.value);
  add("R", "DN/p", report.responsivity.value);
  add("SNR_max", "", report.largestSnr.value);
  add("SNR_max_bit", "bit", Map(report.largestSnr.value, [](double snr) { return std::log2(snr); }));
  add("SNR_max_dB", "dB", Decibels(report.largestSnr.value));
  add("index_u_ysat", "", static_cast<double>(report.saturationPoint));
  add("inverse_K", "$e^-/DN$", Map(gain, [](double g) { return 1.0 / g; }));
  add("inverse_SNR_max", "\\%", Map(report.largestSnr.value, [](double snr) { return 100.0 / snr; }));
  add("sigma_d", "$e^-$", report.darkNoiseElectrons.value);
  add("sigma_y_dark", "DN", report.darkNoise.value);
  add("u_e_min", "$e^-$", report.thresholdElectrons.value);
  add("u_e_sat", "$e^-$", report.saturationElectrons.value);
  add("u_p_min", "$p$", report.thresholdPhotons.value);
  add("u_p_sat", "$p$", report.saturationPhotons.value);
}

/** Adds the variances of the series of the PRNU, or with \a suffix "_dark" of the DSNU. */
void
AddVariances(const EmvaSpatialVariance & of, const char * suffix, std::vector<XmlEntry> & entries)
{
  const auto add = [&](const std::string & name, double value) {
    entries.push_back({ "spatial", name + suffix, "DN2", value });
  };
  add("s_2_y", of.totalDn2);
  add("s_2_y_cav", of.columnMeanDn2);
  add("s_2_y_col", of.columnDn2);
  add("s_2_y_measured", of.measuredDn2);
  add("s_2_y_pixel", of.pixelDn2);
  add("s_2_y_rav", of.rowMeanDn2);
  add("s_2_y_row", of.rowDn2);
  add("sigma_2_y_stack", of.stackDn2);
}

void
AddSpatial(const EmvaReport & report, std::vector<XmlEntry> & entries)
{
  const auto add = [&entries](const char * name, const char * unit, const Quantity & quantity) {
    entries.push_back({ "spatial", name, unit, quantity.value });
  };
  add("DSNU1288", "$e^-$", report.dsnu);
  entries.push_back({ "spatial",
                      "DSNU1288_DN",
                      "DN",
                      report.dsnu.value ? Value(*report.dsnu.value * *report.gain.value) : std::nullopt });
  add("DSNU1288_col", "$e^-$", report.dsnuColumn);
  add("DSNU1288_pixel", "$e^-$", report.dsnuPixel);
  add("DSNU1288_row", "$e^-$", report.dsnuRow);
  add("PRNU1288", "\\%", report.prnu);
  add("PRNU1288_col", "\\%", report.prnuColumn);
  add("PRNU1288_pixel", "\\%", report.prnuPixel);
  add("PRNU1288_row", "\\%", report.prnuRow);
  AddVariances(VariancesOf(report, report.brightStack), "", entries);
  AddVariances(VariancesOf(report, report.darkStack), "_dark", entries);
}

std::vector<XmlEntry>
EntriesOf(const EmvaReport & report)
{
  std::vector<XmlEntry> entries{
    { "dark_current", "u_I_mean", "$e^-/s$", report.darkCurrentElectrons.value },
    { "dark_current", "u_I_mean_DN", "$DN/s$", report.darkCurrent.value },
    { "dark_current", "u_I_var", "$e^-/s$", report.darkCurrentOfVariance.value },
    { "dark_current",
      "u_I_var_DN",
      "$DN/s$",
      Map(report.darkCurrentOfVariance.value, [&](double electrons) { return electrons * *report.gain.value; }) },
    { "linearity", "LE_max", "\\%", report.highestDeviation.value },
    { "linearity", "LE_min", "\\%", report.lowestDeviation.value },
  };
  AddSensitivity(report, entries);
  AddSpatial(report, entries);
  return entries;
}

std::string
DeviationsAsText(const EmvaReport & report)
{
  std::string text;
  for (const EmvaPoint & point : report.points)
  {
    const double line =
      report.linearityOffset.value.value_or(NAN) +
      report.linearitySlope.value.value_or(NAN) * (HasPhotons(report) ? *point.photons : point.exposure);
    text += (text.empty() ? "" : " ") + NumberAsText(100.0 * (point.signalDn - line) / line);
  }
  return text;
}

/** Returns the element of the linearity, the only one with several numbers. */
std::string
LinearityAsXml(const EmvaReport & report)
{
  const auto member = [](const char * name, const std::string & text) {
    return std::string("        <") + name + ">" + text + "</" + name + ">\n";
  };
  return "    <linearity>\n      <section>linearity</section>\n      <data>\n" +
         member("fit_slope", NumberAsText(report.linearitySlope.value)) +
         member("fit_offset", NumberAsText(report.linearityOffset.value)) +
         member("relative_deviation", DeviationsAsText(report)) +
         member("linearity_error_min", NumberAsText(report.lowestDeviation.value)) +
         member("linearity_error_max", NumberAsText(report.highestDeviation.value)) +
         "      </data>\n    </linearity>\n";
}
} // namespace

std::string
ToXml(const EmvaReport & report)
{
  std::string text = "<results>\n";
  std::string section;
  const auto  close = [&] { text += section.empty() ? "" : "  </" + section + ">\n"; };
  for (const XmlEntry & entry : EntriesOf(report))
  {
    if (section != entry.section)
    {
      close();
      section = entry.section;
      text += "  <" + section + ">\n" + (section == "linearity" ? LinearityAsXml(report) : "");
    }
    text += "    <" + entry.name + ">\n      <section>" + entry.section + "</section>\n" +
            (*entry.unit != '\0' ? std::string("      <unit>") + entry.unit + "</unit>\n" : "") + "      <value>" +
            NumberAsText(entry.value) + "</value>\n    </" + entry.name + ">\n";
  }
  close();
  return text + "</results>\n";
}

} // namespace sensornoise
