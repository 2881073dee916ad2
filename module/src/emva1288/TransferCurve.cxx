// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "base/ChiSquare.h"
#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns whether a pair of the same exposure is in the list, in place of this longer series. */
bool
HasPairOf(const EmvaSeries & series, const std::vector<EmvaSeries> & all)
{
  return series.frames > 2 && std::any_of(all.begin(), all.end(), [&series](const EmvaSeries & other) {
           return !other.isDark && other.frames == 2 && other.exposure == series.exposure &&
                  other.photons == series.photons;
         });
}

/** Returns whether most of the flat series are pairs, of as many different exposures as the curve needs. */
bool
AreMostlyPairs(const std::vector<EmvaSeries> & series)
{
  std::set<std::pair<double, double>> pairs; // exposure and photons
  std::size_t                         longer = 0;
  for (const EmvaSeries & each : series)
  {
    if (!each.isDark && each.frames == 2)
    {
      pairs.emplace(each.exposure, each.photons.value_or(0.0));
    }
    else if (!each.isDark)
    {
      ++longer;
    }
  }
  return pairs.size() >= InEmva.fewestPoints && pairs.size() > longer;
}

EmvaPoint
PointOf(const EmvaSeries & series, const DarkLevels & darkLevels)
{
  const DarkLevels::Level dark = darkLevels.At(series.exposure);
  EmvaPoint               point;
  point.exposure = series.exposure;
  point.photons = series.photons;
  point.frames = series.frames;
  point.meanDn = series.meanDn;
  point.signalDn = series.meanDn - dark.meanDn;
  point.varianceDn2 = series.temporalVarianceDn2;
  point.excessDn2 = series.temporalVarianceDn2 - dark.varianceDn2;
  point.snr = series.temporalVarianceDn2 > 0.0 ? point.signalDn / std::sqrt(series.temporalVarianceDn2) : 0.0;
  return point;
}

/** Returns whether so many values of the series are at the end of the range of digital numbers as at saturation. */
bool
IsSaturated(const EmvaSeries & series, const EmvaSettings & settings)
{
  const double top = settings.bitDepth > 0 ? EndOfRangeDn(settings) : series.highestDn;
  return series.highestDn >= top && series.fractionAtHighest >= InEmva.leastSaturatedFraction;
}

/** Throws std::invalid_argument if the series have no temporal noise, or no signal. */
void
RequireSignal(const TransferCurve & curve)
{
  const EmvaPoint & saturation = curve.points[curve.saturation];
  if (!(saturation.varianceDn2 > 0.0))
  {
    throw std::invalid_argument("the frames of each flat exposure are equal, so that they have no temporal noise; "
                                "expected separate frames. List each frame once, and no copies.");
  }
  if (!(saturation.signalDn > 0.0))
  {
    throw std::invalid_argument(
      "the flat field with the largest variance, of the exposure " + Text(saturation.exposure) +
      ", has the mean level " + Text(saturation.meanDn) + " DN, which is " + Text(-saturation.signalDn) +
      " DN below the dark frames; expected brighter flat fields. Check which frames are dark.");
  }
}
} // namespace

double
EndOfRangeDn(const EmvaSettings & settings)
{
  return (std::ldexp(1.0, static_cast<int>(settings.bitDepth)) - 1.0) * std::max(1.0, settings.quantizationStepDn);
}

TransferCurve
MakeTransferCurve(const std::vector<EmvaSeries> & series, const DarkLevels & dark, const EmvaSettings & settings)
{
  TransferCurve curve;
  const bool    areMostlyPairs = AreMostlyPairs(series);
  for (const EmvaSeries & each : series)
  {
    if (!each.isDark && !HasPairOf(each, series))
    {
      (areMostlyPairs && each.frames > 2 ? curve.longer : curve.series).push_back(each);
    }
  }
  curve.hasPhotons = std::all_of(
    curve.series.begin(), curve.series.end(), [](const EmvaSeries & each) { return each.photons.has_value(); });
  const auto abscissa = [&curve](const EmvaSeries & each) { return curve.hasPhotons ? *each.photons : each.exposure; };
  std::stable_sort(curve.series.begin(), curve.series.end(), [&abscissa](const EmvaSeries & a, const EmvaSeries & b) {
    return abscissa(a) < abscissa(b);
  });
  std::set<double> different;
  for (const EmvaSeries & each : curve.series)
  {
    different.insert(abscissa(each));
    curve.points.push_back(PointOf(each, dark));
  }
  if (different.size() < InEmva.fewestPoints)
  {
    throw std::invalid_argument("the flat fields have " + std::to_string(different.size()) +
                                (different.size() == 1 ? " exposure" : " different exposures") +
                                "; expected 3 or more, from dark to saturation. The standard asks for 50.");
  }
  const auto largest = std::max_element(curve.points.begin(), curve.points.end(), [](const auto & a, const auto & b) {
    return a.varianceDn2 < b.varianceDn2;
  });
  curve.saturation = static_cast<std::size_t>(largest - curve.points.begin());
  RequireSignal(curve);
  curve.isSaturated =
    curve.saturation + 1 < curve.points.size() || IsSaturated(curve.series[curve.saturation], settings);
  for (EmvaPoint & point : curve.points)
  {
    point.isInGainFit = point.signalDn <= InEmva.gainRange * curve.SaturationSignalDn();
  }
  return curve;
}

namespace
{
double
StudentOf(const LevelLine & line)
{
  return StudentQuantile(0.975, std::max(1.0, line.dof));
}

/** Returns whether the values have as many different abscissas as a line with an error needs. */
bool
AreEnough(const std::vector<LevelValue> & values)
{
  std::set<double> different;
  for (const LevelValue & value : values)
  {
    different.insert(value.x);
  }
  return different.size() >= InEmva.fewestPoints;
}

/** Returns the relative variance of the error of a variance: 2 / (pixels (frames - 1)) [1]. */
double
RelativeErrorVariance(const EmvaSeries & series)
{
  return 2.0 / (static_cast<double>(series.width * series.height) * (static_cast<double>(series.frames) - 1.0));
}
} // namespace

void
MeasureGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report)
{
  std::vector<LevelValue> values;
  for (std::size_t i = 0; i < curve.points.size(); ++i)
  {
    const EmvaPoint & point = curve.points[i];
    if (point.isInGainFit)
    {
      // one dark series is common to all points and changes the offset alone
      const double ofDark = dark.Series().size() > 1 ? dark.At(point.exposure).varianceError : 0.0;
      values.push_back({ point.signalDn, point.excessDn2, ErrorVarianceOf(curve.series[i]) + ofDark });
    }
  }
  if (AreEnough(values))
  {
    const LevelLine line = FitLevelLine(values);
    report.gain = Filed(WithError(line.slope, line.slopeStandardError, StudentOf(line)), QuantityDomain::Positive);
    const LevelLine origin = FitLineThroughOrigin(values);
    report.gainThroughOrigin =
      Filed(WithError(origin.slope, origin.slopeStandardError, StudentOf(origin)), QuantityDomain::Positive);
  }
}

void
MeasureWeightedGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report)
{
  std::vector<LevelValue> values;
  std::vector<double>     relative;
  const auto              add = [&](const EmvaSeries & series) {
    values.push_back({ series.meanDn, series.temporalVarianceDn2, ErrorVarianceOf(series) });
    relative.push_back(RelativeErrorVariance(series));
  };
  std::for_each(dark.Series().begin(), dark.Series().end(), add);
  for (std::size_t i = 0; i < curve.points.size(); ++i)
  {
    if (curve.points[i].isInGainFit)
    {
      add(curve.series[i]);
    }
  }
  for (const EmvaSeries & each : curve.longer)
  {
    if (each.meanDn - dark.At(each.exposure).meanDn <= InEmva.gainRange * curve.SaturationSignalDn())
    {
      add(each);
    }
  }
  const bool hasNoise =
    std::all_of(values.begin(), values.end(), [](const LevelValue & value) { return value.variance > 0.0; });
  if (!AreEnough(values) || !hasNoise)
  {
    return;
  }
  LevelLine line;
  for (int round = 0; round < InEmva.roundsOfWeights; ++round)
  {
    line = FitWeightedLine(values);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const double expected = line.intercept + line.slope * values[i].x;
      values[i].variance = expected > 0.0 ? relative[i] * expected * expected : values[i].variance;
    }
  }
  line = FitWeightedLine(values);
  const double student = StudentOf(line);
  report.weightedGain = Filed(WithError(line.slope, line.slopeStandardError, student), QuantityDomain::Positive);
  report.weightedIntercept = WithError(line.intercept, line.interceptStandardError, student);
  report.weightedReducedChi2 = Quantity::Identified(line.reducedChi2);
}

void
MeasureResponsivity(const TransferCurve & curve, EmvaReport & report)
{
  std::vector<LevelValue> values;
  for (const EmvaPoint & point : curve.points)
  {
    if (point.isInGainFit && curve.hasPhotons)
    {
      values.push_back({ *point.photons, point.signalDn, 0.0 });
    }
  }
  if (!AreEnough(values))
  {
    return;
  }
  const LevelLine line = FitLineThroughOrigin(values);
  report.responsivity =
    Filed(WithError(line.slope, line.slopeStandardError, StudentOf(line)), QuantityDomain::Positive);
  if (report.gain.value && report.responsivity.value)
  {
    report.quantumEfficiency =
      Propagate([](const auto & of) { return 100.0 * of[0] / of[1]; },
                std::array<FittedNumber, 2>{ NumberOf(report.responsivity), NumberOf(report.gain) });
  }
}

} // namespace sensornoise
