// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/CommonGain.h"

#include "sweep/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{
namespace
{
/** Sums of gains that are weighted by 1 / error squared. */
struct WeightedGains
{
  double weights{ 0.0 };
  double sum{ 0.0 };

  void
  Add(const NumberWithError & gain, double sign)
  {
    const double weight = sign / (gain.standardError * gain.standardError);
    weights += weight;
    sum += weight * gain.value;
  }
  NumberWithError
  Mean() const
  {
    return { sum / weights, 1.0 / std::sqrt(weights) };
  }
};

/** Returns whether a gain has a weight. */
bool
HasGain(const SettingNoise & setting)
{
  return setting.gain && setting.gain->standardError > 0.0;
}

/** Returns the gain over the mean of the others, less 1. */
NumberWithError
DeviationOf(const NumberWithError & gain, const WeightedGains & all)
{
  WeightedGains others = all;
  others.Add(gain, -1.0);
  const NumberWithError mean = others.Mean();
  const double          ratio = gain.value / mean.value;
  return { ratio - 1.0, ratio * std::hypot(gain.standardError / gain.value, mean.standardError / mean.value) };
}
} // namespace

std::optional<CommonGain>
FindCommonGain(const std::vector<SettingNoise> & settings)
{
  RequireSettings(settings);
  WeightedGains all;
  CommonGain    common;
  for (const SettingNoise & each : settings)
  {
    if (HasGain(each))
    {
      all.Add(*each.gain, 1.0);
      ++common.settings;
    }
  }
  if (common.settings < 2)
  {
    return std::nullopt;
  }
  common.gain = all.Mean();
  double chi2 = 0.0;
  double largest = 0.0;
  for (const SettingNoise & each : settings)
  {
    if (!HasGain(each))
    {
      continue;
    }
    const double residual = (each.gain->value - common.gain.value) / each.gain->standardError;
    chi2 += residual * residual;
    const NumberWithError deviation = DeviationOf(*each.gain, all);
    const double          size = std::abs(deviation.value);
    const double          errors = size / deviation.standardError;
    const bool            differs = size > InSweep.leastCommonGainDeviation && errors > Significance.severalTests;
    // a setting that differs counts before others, whose deviation may be small and all the more significant
    if (differs == common.isSame ? differs : errors >= largest && (differs || common.isSame))
    {
      common.isSame = !differs;
      largest = errors;
      common.setting = each.setting;
      common.deviation = deviation;
    }
  }
  common.reducedChi2 = chi2 / static_cast<double>(common.settings - 1);
  common.gain.standardError *= std::sqrt(std::max(1.0, common.reducedChi2));
  return common;
}

} // namespace sensornoise
