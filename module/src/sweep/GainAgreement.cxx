// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
bool
IsPositive(double number)
{
  return std::isfinite(number) && number > 0.0;
}

void
RequirePositive(const std::optional<NumberWithError> & number, const char * name, double setting)
{
  if (number && !(IsPositive(number->value) && std::isfinite(number->standardError) && number->standardError >= 0.0))
  {
    throw std::invalid_argument(std::string("the ") + name + " at the setting " + Text(setting) + " is " +
                                Text(number->value) + " with the error " + Text(number->standardError) +
                                "; expected a number above 0 with an error of 0 or more");
  }
}

double
SquaredErrors(const GainRatio & ratio, double level)
{
  const double errors = (ratio.logRatio - level) / ratio.standardError;
  return errors * errors;
}

double
LossOf(const std::vector<GainRatio> & ratios, std::size_t first, std::size_t last, double level)
{
  const double most = Significance.severalTests * Significance.severalTests;
  double       loss = 0.0;
  for (std::size_t i = first; i < last; ++i)
  {
    loss += std::min(most, SquaredErrors(ratios[i], level));
  }
  return loss;
}
} // namespace

void
RequireSettings(const std::vector<SettingNoise> & settings)
{
  double before = 0.0;
  for (const SettingNoise & each : settings)
  {
    if (!IsPositive(each.setting) || each.setting <= before)
    {
      throw std::invalid_argument("the setting is " + Text(each.setting) + " after " + Text(before) +
                                  "; expected settings above 0 in ascending order, each once");
    }
    before = each.setting;
    RequirePositive(each.gain, "gain", each.setting);
    RequirePositive(each.readNoiseElectrons, "read noise", each.setting);
  }
}

std::vector<GainRatio>
GainRatiosOf(const std::vector<SettingNoise> & settings)
{
  std::vector<GainRatio> ratios;
  for (const SettingNoise & each : settings)
  {
    if (each.gain)
    {
      ratios.push_back({ each.setting,
                         std::log(each.gain->value / each.setting),
                         std::hypot(each.gain->standardError / each.gain->value, InSweep.gainRounding) });
    }
  }
  return ratios;
}

bool
IsOnLevel(const GainRatio & ratio, const GainLevel & level)
{
  const double deviation = std::abs(ratio.logRatio - level.logRatio);
  return deviation <= Significance.oneTest * ratio.standardError || deviation <= std::log1p(InSweep.leastGainDeviation);
}

GainLevel
FindGainLevel(const std::vector<GainRatio> & ratios, std::size_t first, std::size_t last)
{
  GainLevel level;
  level.logRatio = ratios[first].logRatio;
  for (std::size_t i = first; i < last; ++i)
  {
    if (LossOf(ratios, first, last, ratios[i].logRatio) < LossOf(ratios, first, last, level.logRatio))
    {
      level.logRatio = ratios[i].logRatio;
    }
  }
  const GainLevel start = level;
  double          weights = 0.0;
  double          sum = 0.0;
  for (std::size_t i = first; i < last; ++i)
  {
    if (IsOnLevel(ratios[i], start))
    {
      const double weight = 1.0 / (ratios[i].standardError * ratios[i].standardError);
      weights += weight;
      sum += weight * ratios[i].logRatio;
      ++level.settings;
    }
  }
  level.logRatio = sum / weights;
  level.standardError = 1.0 / std::sqrt(weights);
  level.loss = LossOf(ratios, first, last, level.logRatio);
  for (std::size_t i = first; i < last; ++i)
  {
    level.chi2 += IsOnLevel(ratios[i], start) ? SquaredErrors(ratios[i], level.logRatio) : 0.0;
  }
  return level;
}

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
    // A setting that differs takes precedence: the deviation of another setting may be small and more significant.
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
