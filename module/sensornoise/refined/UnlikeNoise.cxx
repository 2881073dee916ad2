// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/UnlikeNoise.h"

#include "sensornoise/base/Quantiles.h"
#include "sensornoise/refined/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

/** Median of the size of a normal number of variance 1. */
constexpr double MedianOfNormal = 0.6745;

double
MedianOf(std::vector<double> values)
{
  return values.empty() ? Unknown : QuantileOf(std::move(values), 0.5);
}

/** The squares of every frame over those that \a line makes of the levels, median over the tiles. */
Eigen::VectorXd
RatiosOfFrames(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & line)
{
  const Eigen::Index               frames = energies.Frames();
  std::vector<std::vector<double>> ofFrames(static_cast<std::size_t>(frames));
  for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
  {
    const Eigen::VectorXd level = levels.Of(energies.LightDn()(i)).head(frames);
    const double          least = InRefined.leastWeighedVariance * energies.SquaresDn2().row(i).mean();
    const Eigen::VectorXd variance = (line.intercept + line.gain * level.array()).max(least);
    const Eigen::VectorXd expected = energies.ExpectedSquares(variance);
    std::vector<double>   ratios;
    std::vector<double>   known;
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      const bool isLeft = energies.LeftShare()(t) > InRefined.leastLeftShare && expected(t) > 0.0;
      ratios.push_back(isLeft ? energies.SquaresDn2()(i, t) / expected(t) : Unknown);
      if (isLeft)
      {
        known.push_back(ratios.back());
      }
    }
    const double typical = MedianOf(known);
    for (std::size_t t = 0; t < ratios.size() && typical > 0.0; ++t)
    {
      if (std::isfinite(ratios[t]))
      {
        ofFrames[t].push_back(ratios[t] / typical);
      }
    }
  }
  Eigen::VectorXd medians(frames);
  for (Eigen::Index t = 0; t < frames; ++t)
  {
    medians(t) = MedianOf(ofFrames[static_cast<std::size_t>(t)]);
  }
  return medians;
}

/** The line turned about its pivot. */
VarianceLine
Turned(const VarianceLine & line, double byGain)
{
  VarianceLine turned = line;
  turned.gain += byGain;
  turned.intercept -= byGain * line.pivotDn;
  return turned;
}
} // namespace

Eigen::VectorXd
NoiseOfFrames(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & line, double slopeError)
{
  if (energies.Tiles() < static_cast<Eigen::Index>(InRefined.leastTilesOfTransfer))
  {
    return {};
  }
  const double                   slack = InRefined.slackOfSlopeZ * slopeError;
  std::array<Eigen::VectorXd, 3> ratios;
  std::array<double, 3>          turns = { -slack, 0.0, slack };
  std::transform(turns.begin(), turns.end(), ratios.begin(), [&](double byGain) {
    return RatiosOfFrames(energies, levels, Turned(line, byGain));
  });
  Eigen::VectorXd nearest = ratios[1];
  for (Eigen::Index t = 0; t < nearest.size(); ++t)
  {
    const double low = std::min({ ratios[0](t), ratios[1](t), ratios[2](t) });
    const double high = std::max({ ratios[0](t), ratios[1](t), ratios[2](t) });
    nearest(t) = std::isfinite(nearest(t)) ? std::clamp(1.0, low, high) : nearest(t);
  }
  return nearest;
}

FrameNoise
JudgeFrameNoise(const Eigen::VectorXd & ofFrames, double chance, double least)
{
  std::vector<double> differences;
  for (Eigen::Index t = 0; t < ofFrames.size(); ++t)
  {
    if (std::isfinite(ofFrames(t)))
    {
      differences.push_back(std::abs(ofFrames(t) - 1.0));
    }
  }
  FrameNoise found;
  if (differences.empty())
  {
    return found;
  }
  const double median = MedianOf(differences);
  const double most = InRefined.unlikeNoiseZ * std::max(chance, median / MedianOfNormal);
  for (Eigen::Index t = 0; t < ofFrames.size(); ++t)
  {
    if (std::abs(ofFrames(t) - 1.0) > std::max(most, least)) // false where it is not known
    {
      found.unlike.push_back(static_cast<std::size_t>(t));
    }
  }
  found.scatter = median > std::max(least, InRefined.unlikeNoiseZ * chance) ? median : 0.0;
  return found;
}

} // namespace sensornoise
