// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/GainLevel.h"

#include "base/Text.h"
#include "sweep/Constants.h"

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

} // namespace sensornoise
