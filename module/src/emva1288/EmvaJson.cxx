// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EmvaText.h"
#include "report/JsonWriter.h"
#include "report/ReportJson.h"
#include "sensornoise/Emva1288.h"
#include "sensornoise/Version.h"

#include <array>
#include <string>

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

} // namespace sensornoise
