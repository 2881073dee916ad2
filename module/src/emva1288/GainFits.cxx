// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "base/ChiSquare.h"
#include "emva1288/Constants.h"
#include "emva1288/DarkLevels.h"
#include "emva1288/LevelLines.h"
#include "emva1288/Propagation.h"
#include "emva1288/TransferCurve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace sensornoise
{

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
