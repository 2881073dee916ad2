// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"

#include "base/Text.h"
#include "emva1288/Constants.h"
#include "emva1288/EvaluationSteps.h"
#include "emva1288/LevelLines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
void
RequireUsable(const std::vector<EmvaSeries> & series, const EmvaSettings & settings)
{
  if (series.empty())
  {
    throw std::invalid_argument("there is no series; expected flat fields at several exposures, and dark frames");
  }
  if (!(settings.quantizationStepDn > 0.0))
  {
    throw std::invalid_argument("the quantization step is " + Text(settings.quantizationStepDn) +
                                " DN; expected a number above 0");
  }
  for (const EmvaSeries & each : series)
  {
    if (!std::isfinite(each.exposure) || each.exposure < 0.0)
    {
      throw std::invalid_argument("an exposure is " + Text(each.exposure) + "; expected a number of 0 or more");
    }
    if (each.width != series.front().width || each.height != series.front().height)
    {
      throw std::invalid_argument(
        "the frames of the exposure " + Text(each.exposure) + " have " + std::to_string(each.width) + " x " +
        std::to_string(each.height) + " pixels, those of the exposure " + Text(series.front().exposure) + " " +
        std::to_string(series.front().width) + " x " + std::to_string(series.front().height) + "; expected one size");
    }
  }
}

/** Adds the remarks on the photon transfer curve. */
void
NoteCurve(const TransferCurve & curve, EmvaReport & report)
{
  const auto inFit =
    std::count_if(curve.points.begin(), curve.points.end(), [](const EmvaPoint & point) { return point.isInGainFit; });
  if (!report.gain.value)
  {
    report.notes.push_back({ "no-gain",
                             "The system gain is not identifiable: " + std::to_string(inFit) +
                               " flat exposures are below 70 % of saturation, and their variance must rise with their "
                               "mean. Record flat fields of at least 3 different exposures in this range." });
  }
  if (!curve.isSaturated)
  {
    report.notes.push_back({ "not-saturated",
                             "The brightest flat fields are not saturated: saturation capacity, maximum SNR and "
                             "dynamic range are at least as large as their bounds, and the ranges of the fits refer to "
                             "the brightest exposure. Record flat fields up to saturation." });
  }
  if (curve.points.size() < InEmva.exposuresOfStandard)
  {
    report.notes.push_back({ "few-exposures",
                             "The flat fields have " + std::to_string(curve.points.size()) +
                               " exposures. The standard asks for " + std::to_string(InEmva.exposuresOfStandard) +
                               "." });
  }
}

/** Adds the remarks on the dark frames. */
void
NoteDark(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report)
{
  const auto unmatched = std::count_if(curve.points.begin(), curve.points.end(), [&dark](const EmvaPoint & point) {
    return !dark.At(point.exposure).isMeasured;
  });
  if (unmatched > 0)
  {
    report.notes.push_back({ "dark-not-matched",
                             std::to_string(unmatched) + " of " + std::to_string(curve.points.size()) +
                               " flat exposures have no dark frames of their own exposure time: the level of the "
                               "nearest dark frames is subtracted. Record dark frames at each exposure time." });
  }
  if (dark.Series().size() < InEmva.darkExposuresOfStandard)
  {
    report.notes.push_back({ "few-dark-exposures",
                             "The dark frames have " + std::to_string(dark.Series().size()) +
                               (dark.Series().size() == 1 ? " exposure time" : " exposure times") +
                               ". A dark current needs " + std::to_string(InEmva.fewestDarkExposures) +
                               ", and the standard asks for " + std::to_string(InEmva.darkExposuresOfStandard) + "." });
  }
  if (report.darkNoise.status == EstimateStatus::UpperLimit)
  {
    report.notes.push_back({ "quantized-dark-noise",
                             "The dark variance is below " + Text(InEmva.leastDarkVariance) +
                               " squared quantization steps: quantization hides the dark noise, which has an upper "
                               "limit alone." });
  }
}

/** Adds the remarks on the non-uniformity. */
void
NoteNonUniformity(EmvaReport & report)
{
  const std::size_t frames =
    std::min(report.series[*report.darkStack].frames, report.series[*report.brightStack].frames);
  if (frames < InEmva.framesOfStandard)
  {
    report.notes.push_back({ "few-frames",
                             "DSNU and PRNU are measured from series of " + std::to_string(frames) +
                               " frames or more. The standard asks for " + std::to_string(InEmva.framesOfStandard) +
                               " at half of saturation and in the dark." });
  }
}
} // namespace

EmvaReport
EvaluateEmva1288(const std::vector<EmvaSeries> & series, const EmvaSettings & settings)
{
  RequireUsable(series, settings);
  const DarkLevels    dark(series);
  const TransferCurve curve = MakeTransferCurve(series, dark, settings);
  EmvaReport          report;
  for (const EmvaQuantityEntry & entry : EmvaQuantityList())
  {
    report.*entry.quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  report.width = series.front().width;
  report.height = series.front().height;
  report.settings = settings;
  report.series = series;
  report.points = curve.points;
  report.saturationPoint = curve.saturation;
  MeasureGain(curve, dark, report);
  MeasureWeightedGain(curve, dark, report);
  MeasureResponsivity(curve, report);
  MeasureDark(dark, report);
  MeasureRange(curve, dark, report);
  MeasureLinearity(curve, report);
  MeasureNonUniformity(dark, curve.SaturationSignalDn(), report);
  ModelSnr(dark, report);
  NoteCurve(curve, report);
  NoteDark(curve, dark, report);
  NoteNonUniformity(report);
  return report;
}

} // namespace sensornoise
