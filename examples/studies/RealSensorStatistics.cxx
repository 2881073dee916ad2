// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorStatistics.h"

#include "simulation/Random.h"
#include "studies/EfficiencyStatistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sensornoise::tools
{

double
Share::Get() const
{
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(met) / static_cast<double>(count);
}

JudgedStatistics
Judge(const std::vector<RealSensorOutcome> & outcomes, JudgedQuantity quantity)
{
  JudgedStatistics statistics;
  Average          z;
  Average          squaredZ;
  Average          standard;
  Average          error;
  for (const RealSensorOutcome & outcome : outcomes)
  {
    const Judged & judged = outcome.Of(quantity);
    statistics.held.Add(judged.Holds());
    statistics.limitsHeld.Add(judged.LimitHolds());
    statistics.bracketsHeld.Add(judged.BracketHolds());
    statistics.inBracket.Add(judged.IsInBracket());
    if (judged.IsIdentified() && judged.truth != 0.0)
    {
      error.Add(100.0 * (*judged.estimate.value - judged.truth) / std::abs(judged.truth));
      if (judged.estimate.standardError)
      {
        standard.Add(100.0 * *judged.estimate.standardError / std::abs(judged.truth));
      }
    }
    if (const auto ratio = judged.Z())
    {
      z.Add(*ratio);
      squaredZ.Add(*ratio * *ratio);
    }
  }
  statistics.rmsZ = std::sqrt(squaredZ.Get());
  statistics.meanZ = z.Get();
  statistics.errorPercent = standard.Get();
  statistics.biasPercent = error.Get();
  return statistics;
}

Share
CountRefused(const std::vector<RealSensorOutcome> & outcomes)
{
  Share refused;
  for (const RealSensorOutcome & outcome : outcomes)
  {
    refused.Add(outcome.IsRefused());
  }
  return refused;
}

std::map<std::string, std::size_t>
CountWarnings(const std::vector<RealSensorOutcome> & outcomes)
{
  std::map<std::string, std::size_t> counts;
  for (const RealSensorOutcome & outcome : outcomes)
  {
    std::vector<WarningCode> codes = outcome.warnings;
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    for (const WarningCode code : codes)
    {
      ++counts[sensornoise::KindOf(code).name];
    }
  }
  return counts;
}

double
BinomialLowerTail(const Share & share, double probability)
{
  const auto n = static_cast<double>(share.count);
  double     tail = 0.0;
  for (std::size_t met = 0; met <= share.met; ++met)
  {
    const auto k = static_cast<double>(met);
    using Random = CounterSeededRandom;
    const double logChoices = Random::LogFactorial(n) - Random::LogFactorial(k) - Random::LogFactorial(n - k);
    tail += std::exp(logChoices + k * std::log(probability) + (n - k) * std::log1p(-probability));
  }
  return std::min(1.0, tail);
}

} // namespace sensornoise::tools
