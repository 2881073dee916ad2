// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "emva1288/LevelLines.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace sensornoise
{

namespace
{
/** A part of the spatial variance, and its error. */
struct SpatialPart
{
  double EmvaSpatialVariance::* variance;  ///< the part [DN^2]
  bool                          ofColumns; ///< the means of the columns determine its error
  bool                          ofRows;    ///< the means of the rows determine its error
};

constexpr SpatialPart Total{ &EmvaSpatialVariance::totalDn2, false, false };
constexpr SpatialPart Columns{ &EmvaSpatialVariance::columnDn2, true, false };
constexpr SpatialPart Rows{ &EmvaSpatialVariance::rowDn2, false, true };
constexpr SpatialPart Pixels{ &EmvaSpatialVariance::pixelDn2, false, false };

/** Returns the number of the series with the most frames of a kind; of equal ones the one with the least distance. */
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
  const double averaged = part.ofColumns ? rows : part.ofRows ? columns : 1.0; // pixels of each value
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

} // namespace sensornoise
