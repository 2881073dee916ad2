// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "base/ChiSquare.h"
#include "emva1288/Constants.h"
#include "emva1288/LevelLines.h"
#include "emva1288/TransferCurve.h"
#include "moments/ExposureFit.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr double Percent100 = 100.0;

/** Returns the numbers of the points whose signal is in the range of the linearity. */
std::vector<std::size_t>
PointsInRange(const TransferCurve & curve)
{
  const double             saturation = curve.SaturationSignalDn();
  std::vector<std::size_t> inRange;
  for (std::size_t i = 0; i < curve.points.size(); ++i)
  {
    const double signal = curve.points[i].signalDn;
    if (signal >= InEmva.linearityLow * saturation && signal <= InEmva.linearityHigh * saturation && signal > 0.0)
    {
      inRange.push_back(i);
    }
  }
  return inRange;
}

/** Returns the signals as levels of a sensor without a dark offset, one of each exposure. */
std::vector<ExposureLevel>
LevelsOf(const TransferCurve & curve)
{
  std::vector<ExposureLevel> levels{ { 0.0, 2, 0.0, 0.0, 0.0, 0.0 } };
  for (std::size_t i = 0; i < curve.points.size(); ++i)
  {
    const EmvaSeries & series = curve.series[i];
    const double       abscissa = curve.AbscissaOf(curve.points[i]);
    const double       noise = series.temporalVarianceDn2 / static_cast<double>(series.width * series.height);
    if (abscissa > levels.back().exposure)
    {
      levels.push_back({ abscissa, series.frames, curve.points[i].signalDn, series.frameSquaresDn2, noise, 0.0 });
    }
  }
  return levels;
}

/** Returns the relative variance of the mean of a series [1]: of the noise of its pixels and of the illumination. */
double
RelativeVariance(const EmvaSeries & series, double signalDn, double illuminationScatter)
{
  const double noise = series.temporalVarianceDn2 / static_cast<double>(series.width * series.height);
  return (noise / (signalDn * signalDn) + illuminationScatter * illuminationScatter) /
         static_cast<double>(series.frames);
}
} // namespace

void
MeasureLinearity(const TransferCurve & curve, EmvaReport & report)
{
  const std::vector<std::size_t> inRange = PointsInRange(curve);
  std::vector<LevelValue>        values;
  values.reserve(inRange.size());
  for (const std::size_t i : inRange)
  {
    values.push_back({ curve.AbscissaOf(curve.points[i]), curve.points[i].signalDn, 0.0 });
  }
  if (inRange.size() < InEmva.fewestPoints || !(values.back().x > values.front().x))
  {
    return;
  }
  CodeRange codes;
  codes.clipHighDn = curve.SaturationSignalDn();
  const ExposureFit   corrected = FitExposures(LevelsOf(curve), codes);
  const LevelLine     line = FitRelativeLine(values);
  double              sum = 0.0;
  double              variance = 0.0;
  std::vector<double> deviations;
  for (std::size_t k = 0; k < inRange.size(); ++k)
  {
    const double fitted = line.intercept + line.slope * values[k].x;
    deviations.push_back(Percent100 * (values[k].y - fitted) / fitted);
    report.points[inRange[k]].deviationPercent = deviations.back();
    sum += std::abs(deviations.back());
    variance += RelativeVariance(curve.series[inRange[k]], values[k].y, corrected.illuminationScatter);
  }
  const auto [lowest, highest] = std::minmax_element(deviations.begin(), deviations.end());
  const auto count = static_cast<double>(deviations.size());
  report.linearityError = Quantity::Identified(sum / count);
  report.linearityError.standardError = Percent100 * std::sqrt(variance) / count;
  report.lowestDeviation = Quantity::Identified(*lowest);
  report.highestDeviation = Quantity::Identified(*highest);
  report.linearitySlope = Quantity::Identified(line.slope);
  report.linearityOffset = Quantity::Identified(line.intercept);
  if (corrected.squaredError && corrected.dof > 0.0)
  {
    report.linearityErrorCorrected = RootOf(Percent100 * Percent100 * corrected.squaredError->value,
                                            Percent100 * Percent100 * corrected.squaredError->standardError,
                                            StudentQuantile(0.975, corrected.dof));
  }
}

} // namespace sensornoise
