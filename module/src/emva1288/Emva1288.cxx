// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"

#include "base/Text.h"
#include "emva1288/EvaluationSteps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
/** A part of the spatial variance, and the means that determine its error. */
struct SpatialPart
{
  double EmvaSpatialVariance::* variance;  ///< variance of the part [DN^2]
  bool                          ofColumns; ///< the means of the columns determine the error of the part
  bool                          ofRows;    ///< the means of the rows determine the error of the part
};

constexpr SpatialPart Total{ &EmvaSpatialVariance::totalDn2, false, false };
constexpr SpatialPart Columns{ &EmvaSpatialVariance::columnDn2, true, false };
constexpr SpatialPart Rows{ &EmvaSpatialVariance::rowDn2, false, true };
constexpr SpatialPart Pixels{ &EmvaSpatialVariance::pixelDn2, false, false };

/** Returns the index of the series of a kind (dark or flat) with the most frames. Among series of equal length, it has
 * the least distance. Null: no series is of this kind. */
template <typename TDistance>
std::optional<std::size_t>
LongestSeries(const std::vector<EmvaSeries> & series, bool isDark, TDistance distance)
{
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    if (series[i].isDark == isDark &&
        (!best || series[i].frames > series[*best].frames ||
         (series[i].frames == series[*best].frames && distance(series[i]) < distance(series[*best]))))
    {
      best = i;
    }
  }
  return best;
}

/** Returns a part of the variance with its standard error [DN^2]. A variance of n values has the relative variance 2 /
 * n; so has the temporal variance that is subtracted. */
FittedNumber
PartOf(const EmvaSpatialVariance & of, std::size_t frames, const SpatialPart & part)
{
  const auto   columns = static_cast<double>(of.columns);
  const auto   rows = static_cast<double>(of.rows);
  const auto   count = static_cast<double>(frames);
  const double values = part.ofColumns ? columns : part.ofRows ? rows : columns * rows;
  const double averaged = part.ofColumns ? rows
                          : part.ofRows  ? columns
                                         : 1.0; // number of pixels averaged in each value
  const double noise = of.stackDn2 / count / averaged;
  const double measured = part.ofColumns ? of.columnMeanDn2 + noise
                          : part.ofRows  ? of.rowMeanDn2 + noise
                                         : of.measuredDn2;
  const double variance = 2.0 * measured * measured / values + 2.0 * noise * noise / (columns * rows * (count - 1.0));
  return { of.*(part.variance), std::sqrt(variance) };
}

/** Returns the root of a spatial variance over the gain [e-]. */
Quantity
DsnuOf(const FittedNumber & variance, const FittedNumber & gain)
{
  const double electrons2 = variance.value / (gain.value * gain.value);
  const double ofGain = 2.0 * electrons2 * gain.standardError / gain.value;
  return RootOf(electrons2, std::hypot(variance.standardError / (gain.value * gain.value), ofGain));
}

/** Returns the root of the difference of the variances, relative to the signal [%]. */
Quantity
PrnuOf(const FittedNumber & bright, const FittedNumber & dark, double signalDn)
{
  const double scale = 1e4 / (signalDn * signalDn);
  return RootOf(scale * (bright.value - dark.value), scale * std::hypot(bright.standardError, dark.standardError));
}
} // namespace

void
MeasureNonUniformity(const DarkLevels & dark, double saturationSignalDn, EmvaReport & report)
{
  const auto signalOf = [&dark](const EmvaSeries & series) { return series.meanDn - dark.At(series.exposure).meanDn; };
  report.brightStack = LongestSeries(report.series, false, [&](const EmvaSeries & series) {
    return std::abs(signalOf(series) - 0.5 * saturationSignalDn);
  });
  const EmvaSeries & bright = report.series[*report.brightStack];
  report.darkStack = LongestSeries(
    report.series, true, [&bright](const EmvaSeries & series) { return std::abs(series.exposure - bright.exposure); });
  const EmvaSeries & darkSeries = report.series[*report.darkStack];
  const double       signalDn = bright.meanDn - darkSeries.meanDn;
  const auto         measure = [&](const EmvaSpatialVariance & ofBright,
                           const EmvaSpatialVariance & ofDark,
                           const SpatialPart &         part,
                           Quantity &                  dsnu,
                           Quantity &                  prnu) {
    const FittedNumber inDark = PartOf(ofDark, darkSeries.frames, part);
    if (report.gain.value)
    {
      dsnu = DsnuOf(inDark, NumberOf(report.gain));
    }
    if (signalDn > 0.0)
    {
      prnu = PrnuOf(PartOf(ofBright, bright.frames, part), inDark, signalDn);
    }
  };
  measure(bright.unfiltered, darkSeries.unfiltered, Total, report.dsnuUnfiltered, report.prnuUnfiltered);
  if (bright.highpass && darkSeries.highpass)
  {
    measure(*bright.highpass, *darkSeries.highpass, Total, report.dsnu, report.prnu);
    measure(*bright.highpass, *darkSeries.highpass, Columns, report.dsnuColumn, report.prnuColumn);
    measure(*bright.highpass, *darkSeries.highpass, Rows, report.dsnuRow, report.prnuRow);
    measure(*bright.highpass, *darkSeries.highpass, Pixels, report.dsnuPixel, report.prnuPixel);
  }
}

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
  if (settings.bitDepth > InEmva.largestBitDepth)
  {
    throw std::invalid_argument("the bit depth is " + std::to_string(settings.bitDepth) + "; expected at most " +
                                std::to_string(InEmva.largestBitDepth) + ", or 0 if it is not known");
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
        std::to_string(each.height) + " pixels, the frames of the exposure " + Text(series.front().exposure) + " " +
        std::to_string(series.front().width) + " x " + std::to_string(series.front().height) + "; expected one size");
    }
    if (settings.bitDepth > 0 && each.highestDn > EndOfRangeDn(settings))
    {
      throw std::invalid_argument("the data hold the level " + Text(each.highestDn) + " DN, but " +
                                  std::to_string(settings.bitDepth) + " bits with a quantization step of " +
                                  Text(settings.quantizationStepDn) + " DN end at " + Text(EndOfRangeDn(settings)) +
                                  " DN; give a larger bit depth, or the quantization step of shifted numbers");
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
