// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "base/Eigen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
/** One sign of a switch at one place. */
struct StepSign
{
  double          below{ 0.0 };
  double          above{ 0.0 };
  NumberWithError ratio;
  double          chi2{ 0.0 }; ///< reduction of chi-square by the step [1]
};

/** Read noises squared, and what the model fits to them. */
struct ReadNoiseData
{
  Eigen::VectorXd settings;
  Eigen::VectorXd squares; ///< sigma^2 [e-^2]
  Eigen::VectorXd errors;  ///< standard errors of the squares [e-^2]
};

/** The fit sigma^2 = A + B / setting^2, or A + D before and A behind a switch. */
struct ReadNoiseFit
{
  Eigen::VectorXd terms; ///< A, B, and D with a switch
  Eigen::MatrixXd covariance;
  double          chi2{ 0.0 };
};

ReadNoiseData
ReadNoisesOf(const std::vector<SettingNoise> & settings)
{
  std::vector<SettingNoise> known;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(known), [](const SettingNoise & each) {
    return each.readNoiseElectrons.has_value();
  });
  const auto    count = static_cast<Eigen::Index>(known.size());
  ReadNoiseData data{ Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count) };
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const SettingNoise & each = known[static_cast<std::size_t>(i)];
    const double         sigma = each.readNoiseElectrons->value;
    data.settings[i] = each.setting;
    data.squares[i] = sigma * sigma;
    data.errors[i] =
      2.0 * sigma * std::hypot(each.readNoiseElectrons->standardError, InSweep.readNoiseModelError * sigma);
  }
  return data;
}

/** Fits with a switch before the setting \a behind, or without one if it is 0. B is 0 where it would be negative. */
ReadNoiseFit
FitReadNoise(const ReadNoiseData & data, Eigen::Index behind, bool hasAmplifierNoise = true)
{
  const Eigen::Index count = data.settings.size();
  Eigen::MatrixXd    columns = Eigen::MatrixXd::Zero(count, behind > 0 ? 3 : 2);
  columns.col(0).setOnes();
  columns.col(1) = (data.settings.array() / data.settings[0]).square().inverse() * (hasAmplifierNoise ? 1.0 : 0.0);
  if (behind > 0)
  {
    columns.col(2).head(behind).setOnes();
  }
  columns = data.errors.asDiagonal().inverse() * columns;
  const Eigen::VectorXd wanted = data.squares.cwiseQuotient(data.errors);
  ReadNoiseFit          fit;
  fit.covariance = (columns.transpose() * columns).completeOrthogonalDecomposition().pseudoInverse();
  fit.terms = fit.covariance * (columns.transpose() * wanted);
  fit.chi2 = (columns * fit.terms - wanted).squaredNorm();
  return fit.terms[1] < 0.0 ? FitReadNoise(data, behind, false) : fit;
}

/** Read noise behind the switch relative to the read noise without it, at the geometric mean of the settings beside it.
 */
NumberWithError
ReadNoiseRatio(const ReadNoiseFit & fit, const ReadNoiseData & data, Eigen::Index behind)
{
  const double          middle = data.settings[behind] * data.settings[behind - 1];
  const double          amplifier = data.settings[0] * data.settings[0] / middle;
  const Eigen::Vector3d with(1.0, amplifier, 0.0);
  const Eigen::Vector3d without(1.0, amplifier, 1.0);
  const double          above = std::max(0.0, with.dot(fit.terms));
  const double          below = without.dot(fit.terms);
  const double          ratio = std::sqrt(above / below);
  if (above == 0.0)
  {
    return { 0.0, 0.0 };
  }
  const Eigen::Vector3d slope =
    0.5 * ratio * (with / above - without / below); // derivatives of the ratio by A, B and D
  return { ratio, std::sqrt(slope.dot(fit.covariance * slope)) };
}

std::optional<StepSign>
FindReadNoiseStep(const std::vector<SettingNoise> & settings)
{
  const ReadNoiseData data = ReadNoisesOf(settings);
  const Eigen::Index  count = data.settings.size();
  const auto          side = static_cast<Eigen::Index>(InSweep.leastSettingsOfSide);
  if (count < static_cast<Eigen::Index>(InSweep.leastReadNoises))
  {
    return std::nullopt;
  }
  const double            chi2Without = FitReadNoise(data, 0).chi2;
  std::optional<StepSign> best;
  for (Eigen::Index behind = side; behind <= count - side; ++behind)
  {
    const ReadNoiseFit    fit = FitReadNoise(data, behind);
    const double          reduced = fit.chi2 / static_cast<double>(count - 3);
    const NumberWithError ratio = ReadNoiseRatio(fit, data, behind);
    const double          chi2 = (chi2Without - fit.chi2) / std::max(1.0, reduced);
    if (ratio.value <= 1.0 - InSweep.leastReadNoiseDrop && (!best || chi2 > best->chi2))
    {
      best = { data.settings[behind - 1], data.settings[behind], ratio, chi2 };
    }
  }
  return best;
}

std::optional<StepSign>
FindGainStep(const std::vector<SettingNoise> & settings)
{
  const std::vector<GainRatio> ratios = GainRatiosOf(settings);
  const std::size_t            side = InSweep.leastSettingsOfSide;
  if (ratios.size() < 2 * side)
  {
    return std::nullopt;
  }
  const double            lossWithout = FindGainLevel(ratios, 0, ratios.size()).loss;
  std::optional<StepSign> best;
  for (std::size_t behind = side; behind <= ratios.size() - side; ++behind)
  {
    const GainLevel before = FindGainLevel(ratios, 0, behind);
    const GainLevel after = FindGainLevel(ratios, behind, ratios.size());
    const double    step = after.logRatio - before.logRatio;
    const double    chi2 = lossWithout - before.loss - after.loss;
    const bool      areEnough = before.settings >= side && after.settings >= side;
    if (areEnough && std::abs(step) > std::log1p(InSweep.leastGainDeviation) && (!best || chi2 > best->chi2))
    {
      const double ratio = std::exp(step);
      best = { ratios[behind - 1].setting,
               ratios[behind].setting,
               { ratio, ratio * std::hypot(before.standardError, after.standardError) },
               chi2 };
    }
  }
  return best;
}

std::optional<StepSign>
IfSignificant(const std::optional<StepSign> & sign)
{
  const double least = Significance.severalTests * Significance.severalTests;
  return sign && sign->chi2 > least ? sign : std::nullopt;
}
} // namespace

std::optional<GainSwitch>
FindGainSwitch(const std::vector<SettingNoise> & settings)
{
  RequireSettings(settings);
  std::optional<StepSign> gain = IfSignificant(FindGainStep(settings));
  std::optional<StepSign> readNoise = IfSignificant(FindReadNoiseStep(settings));
  if (gain && readNoise && (gain->below >= readNoise->above || readNoise->below >= gain->above))
  {
    (gain->chi2 < readNoise->chi2 ? gain : readNoise).reset();
  }
  if (!gain && !readNoise)
  {
    return std::nullopt;
  }
  const StepSign & first = gain ? *gain : *readNoise;
  const StepSign & second = readNoise ? *readNoise : *gain;
  GainSwitch       found{ std::max(first.below, second.below), std::min(first.above, second.above), {}, {} };
  found.gainStep = gain ? std::optional<NumberWithError>(gain->ratio) : std::nullopt;
  found.readNoiseStep = readNoise ? std::optional<NumberWithError>(readNoise->ratio) : std::nullopt;
  return found;
}

GainLine
FitGainLine(const std::vector<SettingNoise> & settings, const std::optional<GainSwitch> & conversionSwitch)
{
  RequireSettings(settings);
  GainLine line;
  line.deviation.resize(settings.size());
  line.isBeside.resize(settings.size(), false);
  const std::vector<GainRatio> ratios = GainRatiosOf(settings);
  const bool                   hasStep = conversionSwitch && conversionSwitch->gainStep;
  const auto                   middle = std::partition_point(ratios.begin(), ratios.end(), [&](const GainRatio & each) {
    return !hasStep || each.setting <= conversionSwitch->below;
  });
  const auto                   split = static_cast<std::size_t>(middle - ratios.begin());
  for (const auto & [first, last] : { std::pair(std::size_t{ 0 }, split), std::pair(split, ratios.size()) })
  {
    if (last - first < 2)
    {
      continue;
    }
    const GainLevel level = FindGainLevel(ratios, first, last);
    if (level.settings < 2 || 2 * level.settings <= last - first)
    {
      continue;
    }
    const double scale = std::exp(level.logRatio);
    line.parts.push_back({ { scale, scale * level.standardError },
                           ratios[first].setting,
                           ratios[last - 1].setting,
                           level.settings,
                           level.chi2 / static_cast<double>(level.settings - 1) });
    for (std::size_t i = first; i < last; ++i)
    {
      const auto place = std::find_if(
        settings.begin(), settings.end(), [&](const SettingNoise & each) { return each.setting == ratios[i].setting; });
      const auto index = static_cast<std::size_t>(place - settings.begin());
      line.deviation[index] = std::expm1(ratios[i].logRatio - level.logRatio);
      line.isBeside[index] = !IsOnLevel(ratios[i], level);
    }
  }
  return line;
}

} // namespace sensornoise
