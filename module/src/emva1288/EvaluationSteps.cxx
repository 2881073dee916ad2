// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "base/ChiSquare.h"
#include "moments/Exposures.h"
#include "report/Quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the dark variance with quantization noise, 0.24 squared steps or more [DN^2]. */
FittedNumber
LimitedDarkVariance(const DarkLevels & dark, const EmvaReport & report, bool & isLimit)
{
  const double step2 = report.settings.quantizationStepDn * report.settings.quantizationStepDn;
  FittedNumber variance = dark.DarkVariance();
  isLimit = variance.value < InEmva.leastDarkVariance * step2;
  return isLimit ? FittedNumber{ InEmva.leastDarkVariance * step2, 0.0 } : variance;
}

/** Returns the threshold in electrons at which signal and noise are equal (26). */
double
ThresholdElectrons(double darkVarianceDn2, double gain)
{
  return std::sqrt(darkVarianceDn2 / (gain * gain) + 0.25) + 0.5;
}

/** Returns an upper limit in place of the value. */
Quantity
AsUpperLimit(const Quantity & quantity)
{
  return quantity.value ? UpperLimit(*quantity.value) : quantity;
}

/** Returns a lower bound in place of the value. */
Quantity
AsLowerBound(const Quantity & quantity)
{
  return quantity.value ? Quantity::Without(EstimateStatus::NotIdentifiable, Interval{ quantity.value, std::nullopt })
                        : quantity;
}
} // namespace

void
MeasureDark(const DarkLevels & dark, EmvaReport & report)
{
  bool               isLimit = false;
  const FittedNumber variance = LimitedDarkVariance(dark, report, isLimit);
  const double       step = report.settings.quantizationStepDn;
  const double       quantization = InEmva.quantizationVariance * step * step;
  const EmvaSeries & first = dark.Series().front();
  report.darkSignal = Quantity::Identified(first.meanDn);
  report.darkSignal.standardError =
    std::sqrt(first.frameSquaresDn2 / ((static_cast<double>(first.frames) - 1.0) * static_cast<double>(first.frames)));
  report.darkNoise = isLimit ? UpperLimit(std::sqrt(variance.value)) : RootOf(variance.value, variance.standardError);
  if (!report.gain.value)
  {
    return;
  }
  const FittedNumber gain = NumberOf(report.gain);
  report.darkNoiseElectrons =
    isLimit ? UpperLimit(InEmva.darkNoiseLimit * step / gain.value)
            : Propagate([quantization](const auto & of) { return std::sqrt(of[0] - quantization) / of[1]; },
                        std::array<FittedNumber, 2>{ variance, gain });
  if (dark.HasLine())
  {
    const LevelLine mean = dark.MeanLine();
    const LevelLine ofVariance = dark.VarianceLine();
    const double    student = StudentQuantile(0.975, mean.dof);
    report.darkCurrent = WithError(mean.slope, mean.slopeStandardError, student);
    report.darkCurrentElectrons =
      WithError(mean.slope / gain.value,
                std::hypot(mean.slopeStandardError, mean.slope * gain.standardError / gain.value) / gain.value,
                student);
    const double electrons = ofVariance.slope / (gain.value * gain.value);
    report.darkCurrentOfVariance = WithError(electrons,
                                             std::hypot(ofVariance.slopeStandardError / (gain.value * gain.value),
                                                        2.0 * electrons * gain.standardError / gain.value),
                                             student);
  }
}

void
MeasureRange(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report)
{
  report.saturationSignal = Quantity::Identified(curve.SaturationSignalDn());
  if (curve.hasPhotons)
  {
    report.saturationPhotons = Quantity::Identified(*curve.points[curve.saturation].photons);
  }
  if (!report.gain.value)
  {
    return;
  }
  bool                              isLimit = false;
  const FittedNumber                variance = LimitedDarkVariance(dark, report, isLimit);
  const bool                        hasEfficiency = report.quantumEfficiency.value.has_value();
  const double                      photons = report.saturationPhotons.value.value_or(0.0);
  const double                      signal = curve.SaturationSignalDn();
  const std::array<FittedNumber, 3> numbers{ variance, NumberOf(report.gain), NumberOf(report.responsivity) };
  const auto electrons = [=](const auto & of) { return (hasEfficiency ? of[2] * photons : signal) / of[1]; };
  const auto threshold = [](const auto & of) { return ThresholdElectrons(of[0], of[1]); };
  report.saturationElectrons = Propagate(electrons, numbers);
  report.largestSnr = Propagate([&](const auto & of) { return std::sqrt(electrons(of)); }, numbers);
  report.thresholdElectrons = Propagate(threshold, numbers);
  report.dynamicRange = Propagate([&](const auto & of) { return electrons(of) / threshold(of); }, numbers);
  if (hasEfficiency)
  {
    report.thresholdPhotons = Propagate([&](const auto & of) { return threshold(of) * of[1] / of[2]; }, numbers);
  }
  if (isLimit)
  {
    report.thresholdElectrons = AsUpperLimit(report.thresholdElectrons);
    report.thresholdPhotons = AsUpperLimit(report.thresholdPhotons);
  }
  if (!curve.isSaturated)
  {
    for (Quantity * const quantity :
         { &report.saturationSignal, &report.saturationPhotons, &report.saturationElectrons, &report.largestSnr })
    {
      *quantity = AsLowerBound(*quantity);
    }
  }
  if (isLimit || !curve.isSaturated)
  {
    report.dynamicRange = AsLowerBound(report.dynamicRange);
  }
}

void
ModelSnr(const DarkLevels & dark, EmvaReport & report)
{
  if (!report.gain.value)
  {
    return;
  }
  bool         isLimit = false;
  const double gain = *report.gain.value;
  const double darkElectrons2 = LimitedDarkVariance(dark, report, isLimit).value / (gain * gain);
  for (EmvaPoint & point : report.points)
  {
    const double electrons = report.quantumEfficiency.value && point.photons
                               ? 0.01 * *report.quantumEfficiency.value * *point.photons
                               : point.signalDn / gain;
    const double noise = darkElectrons2 + electrons;
    if (noise > 0.0)
    {
      point.modelSnr = electrons / std::sqrt(noise);
      const double ofPattern = 0.01 * report.prnu.value.value_or(0.0) * electrons;
      point.totalSnr =
        electrons / std::sqrt(noise + std::pow(report.dsnu.value.value_or(0.0), 2) + ofPattern * ofPattern);
    }
  }
}

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
  DnRange dnRange;
  dnRange.clipHighDn = curve.SaturationSignalDn();
  const ExposureFit   corrected = FitExposures(LevelsOf(curve), dnRange);
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
