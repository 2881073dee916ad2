// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/EfficiencyStatistics.h"

#include <cmath>

namespace sensornoise::tools
{
namespace
{
bool
Holds(const Interval & interval, double value)
{
  return value >= interval.low.value_or(value) && value <= interval.high.value_or(value);
}
} // namespace

EfficiencyStatistics
JudgeEfficiency(const std::vector<const EfficiencyRun *> & runs, std::size_t row)
{
  EfficiencyStatistics statistics;
  Average              truth;
  Average              relative;
  Average              squared;
  Average              relativeSquared;
  Average              limitSquared;
  Average              limit;
  Average              held;
  Average              standardSquared;
  for (const EfficiencyRun * run : runs)
  {
    const EfficiencySample & sample = run->samples[row];
    ++statistics.stacks;
    truth.Add(sample.truth);
    if (!sample.IsIdentified())
    {
      continue;
    }
    ++statistics.identified;
    const double error = *sample.estimate.value - sample.truth;
    squared.Add(error * error);
    if (sample.truth != 0.0)
    {
      relative.Add(error / std::abs(sample.truth));
      relativeSquared.Add(error * error / (sample.truth * sample.truth));
    }
    if (std::isfinite(sample.limit))
    {
      limit.Add(error / sample.limit);
      limitSquared.Add(error * error / (sample.limit * sample.limit));
    }
    if (sample.estimate.interval95)
    {
      held.Add(Holds(*sample.estimate.interval95, sample.truth) ? 1.0 : 0.0);
    }
    if (sample.estimate.standardError)
    {
      standardSquared.Add(std::pow(error / *sample.estimate.standardError, 2));
    }
  }
  statistics.truth = truth.Get();
  statistics.relativeBias = relative.Get();
  statistics.rmsError = std::sqrt(squared.Get());
  statistics.relativeRms = std::sqrt(relativeSquared.Get());
  statistics.rmsOverLimit = std::sqrt(limitSquared.Get());
  statistics.biasOverLimit = limit.Get();
  statistics.coverage = held.Get();
  statistics.rmsOverStandard = std::sqrt(standardSquared.Get());
  return statistics;
}

} // namespace sensornoise::tools
