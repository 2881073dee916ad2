// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"

#include "base/ChiSquare.h"
#include "correlation/Constants.h"
#include "moments/Constants.h"
#include "pixels/GainByParts.h"
#include "refined/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Data of a regression of the squared residuals: E[squares] = V(0) C + gain X, where C is the fraction of the noise
 * that remains in the residuals, and X the expected squares for a variance equal to the level. */
struct Regression
{
  explicit Regression(const FrameEnergies & energies, const TileLevels & levels)
    : squares(energies.SquaresDn2())
    , ofConstant(energies.RemainingFraction())
    , ofLevel(energies.Tiles(), energies.Frames())
    , pixels(energies.Pixels())
  {
    for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
    {
      ofLevel.row(i) = energies.ExpectedSquares(levels.Of(energies.SignalDn()(i)).head(energies.Frames())).transpose();
    }
  }

  const Eigen::MatrixXd & squares; ///< tiles x frames [DN^2]
  Eigen::VectorXd         ofConstant;
  Eigen::MatrixXd         ofLevel; ///< tiles x frames [DN]
  const Eigen::VectorXd & pixels;
};

/** Returns approximate inverse variances of the squared residuals: a squared normal value has a variance of twice its
 * squared expectation. The weight is 0 for frames with less than InRefined.leastRemainingFraction of their noise in the
 * residuals. */
Eigen::MatrixXd
WeightsBy(const Regression & data, const VarianceLine & line)
{
  Eigen::MatrixXd weights(data.squares.rows(), data.squares.cols());
  for (Eigen::Index t = 0; t < weights.cols(); ++t)
  {
    const bool isLeft = data.ofConstant(t) > InRefined.leastRemainingFraction;
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
    {
      const double least = InRefined.leastWeighedVariance * data.squares.row(i).mean() * data.ofConstant(t);
      const double expected = std::max(least, line.intercept * data.ofConstant(t) + line.gain * data.ofLevel(i, t));
      weights(i, t) = isLeft && expected > 0.0 ? 0.5 * data.pixels(i) / (expected * expected) : 0.0;
    }
  }
  return weights;
}

/** Fits one line through the squared residuals of all tiles, for their weights. */
VarianceLine
FitAllTiles(const Regression & data, const Eigen::MatrixXd & weights)
{
  Eigen::Matrix2d gram = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (Eigen::Index t = 0; t < weights.cols(); ++t)
  {
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
    {
      const Eigen::Vector2d row(data.ofLevel(i, t), data.ofConstant(t));
      gram += weights(i, t) * row * row.transpose();
      right += weights(i, t) * row * data.squares(i, t);
    }
  }
  VarianceLine          line;
  const Eigen::Vector2d solution = gram.ldlt().solve(right);
  line.gain = solution(0);
  line.intercept = solution(1);
  line.isDetermined = solution.allFinite();
  return line;
}

/** Weighted mean over tiles: the sum of the numerators over the sum of the denominators. */
struct TileMean
{
  Eigen::VectorXd numerators;
  Eigen::VectorXd denominators;

  double
  Value() const
  {
    return numerators.sum() / denominators.sum();
  }
  /** Returns the variance of the mean from the scatter between tiles, at least the variance by their weights. It is
   * wider if there are few tiles, by Student's quantile. */
  double
  Variance() const
  {
    const auto            tiles = static_cast<double>(numerators.size());
    const Eigen::VectorXd scores = numerators - this->Value() * denominators;
    const double          scatter = scores.squaredNorm() * tiles / (tiles - 1.0);
    const double          student = StudentQuantile(0.975, tiles - 1.0) / StudentQuantile(0.975, 1e6);
    return std::max(1.0 / denominators.sum(), student * student * scatter / std::pow(denominators.sum(), 2));
  }
};

/** Slope of the squared residuals between frames, within each tile. */
struct FrameSlope
{
  TileMean        ofTiles;
  Eigen::VectorXd information; ///< contribution of each frame to the denominators
};

FrameSlope
SlopeOfTiles(const Regression & data, const Eigen::MatrixXd & weights)
{
  FrameSlope slope{ { Eigen::VectorXd(weights.rows()), Eigen::VectorXd(weights.rows()) },
                    Eigen::VectorXd::Zero(weights.cols()) };
  for (Eigen::Index i = 0; i < weights.rows(); ++i)
  {
    const Eigen::VectorXd w = weights.row(i).transpose();
    const Eigen::VectorXd weighed = w.cwiseProduct(data.ofConstant);
    const double          constant = weighed.dot(data.ofConstant);
    Eigen::VectorXd       x = data.ofLevel.row(i).transpose();
    if (constant > 0.0)
    {
      x -= data.ofConstant * (weighed.dot(x) / constant);
    }
    const Eigen::VectorXd wx = w.cwiseProduct(x);
    slope.ofTiles.numerators(i) = wx.dot(data.squares.row(i));
    slope.ofTiles.denominators(i) = wx.dot(x);
    slope.information += wx.cwiseProduct(x);
  }
  return slope;
}

/** Returns the fraction of the information on the slope that remains without the fifth of the frames that contribute
 * most [1]. Up to a fifth of the frames may have other noise, and a slope that depends on these frames alone is not
 * identifiable. */
double
InformationWithoutLargest(const Regression & data, Eigen::MatrixXd weights, const FrameSlope & slope)
{
  std::vector<Eigen::Index> frames(static_cast<std::size_t>(weights.cols()));
  std::iota(frames.begin(), frames.end(), Eigen::Index{ 0 });
  std::stable_sort(frames.begin(), frames.end(), [&](Eigen::Index a, Eigen::Index b) {
    return slope.information(a) > slope.information(b);
  });
  frames.resize(static_cast<std::size_t>(InMoments.largestLeftOutFraction * static_cast<double>(weights.cols())));
  for (const Eigen::Index t : frames)
  {
    weights.col(t).setZero();
  }
  return SlopeOfTiles(data, weights).information.sum() / slope.information.sum();
}

/** Variance at level 0 for a given slope, and the pivot, the level at which the variance does not depend on the slope.
 */
struct ValueOfTiles
{
  TileMean value;
  double   pivotDn{ 0.0 };
};

ValueOfTiles
ValueAtZero(const Regression & data, const Eigen::MatrixXd & weights, double gain)
{
  const Eigen::MatrixXd weighed = weights * data.ofConstant.asDiagonal();
  const double          levels = weighed.cwiseProduct(data.ofLevel).sum();
  ValueOfTiles          found;
  found.value.denominators = weighed * data.ofConstant;
  found.value.numerators = weighed.cwiseProduct(data.squares - gain * data.ofLevel).rowwise().sum();
  found.pivotDn = levels / found.value.denominators.sum();
  return found;
}

/** Returns the deviations of the frames from the line, with one bin for each frame, sorted by their mean levels. Each
 * tile has its own constant, as in the fit of the slope. */
VarianceCurve
CurveOfFrames(const Regression &      data,
              const Eigen::MatrixXd & weights,
              const FrameEnergies &   energies,
              const TileLevels &      levels,
              const VarianceLine &    line)
{
  VarianceCurve curve{ line, std::vector<CurveBin>(static_cast<std::size_t>(weights.cols())) };
  for (Eigen::Index i = 0; i < weights.rows(); ++i)
  {
    const Eigen::VectorXd weighed = weights.row(i).transpose().cwiseProduct(data.ofConstant);
    const double          constant = weighed.dot(data.ofConstant);
    const Eigen::VectorXd beyond = (data.squares.row(i) - line.gain * data.ofLevel.row(i)).transpose();
    const double          own = constant > 0.0 ? weighed.dot(beyond) / constant : 0.0;
    const Eigen::VectorXd levelsDn = levels.Of(energies.SignalDn()(i));
    for (Eigen::Index t = 0; t < weights.cols(); ++t)
    {
      const double weight = weighed(t) * data.ofConstant(t); // weight of a variance, not of a squared residual
      curve.bins[static_cast<std::size_t>(t)] += { weight > 0.0 ? data.pixels(i) : 0.0,
                                                   weight,
                                                   weight * (levelsDn(t) - line.pivotDn),
                                                   weighed(t) * (beyond(t) - own * data.ofConstant(t)) };
    }
  }
  curve.bins.erase(
    std::remove_if(curve.bins.begin(), curve.bins.end(), [](const CurveBin & bin) { return !(bin.weight > 0.0); }),
    curve.bins.end());
  std::stable_sort(curve.bins.begin(), curve.bins.end(), [](const CurveBin & a, const CurveBin & b) {
    return a.x / a.weight < b.x / b.weight;
  });
  return curve;
}
} // namespace

TileLevels::TileLevels(const std::vector<double> & gamma, double offsetDn, double zeroDn, bool isLocal)
  : m_Illumination(Eigen::Map<const Eigen::VectorXd>(gamma.data(), static_cast<Eigen::Index>(gamma.size())).array() +
                   1.0)
  , m_OffsetDn(offsetDn)
  , m_ZeroDn(zeroDn)
  , m_IsLocal(isLocal)
{}

Eigen::VectorXd
TileLevels::Of(double signalDn) const
{
  return m_OffsetDn + m_Illumination.array() * (signalDn + m_ZeroDn - m_OffsetDn);
}

Eigen::VectorXd
TileLevels::Of(const FrameEnergies & energies, Eigen::Index tile) const
{
  const double signalDn = energies.SignalDn()(tile);
  return m_IsLocal ? Eigen::VectorXd(m_ZeroDn + signalDn + energies.LevelChangesDn().row(tile).transpose().array())
                   : Eigen::VectorXd(this->Of(signalDn).head(energies.Frames()));
}

double
LeastVarianceDn2(const FrameEnergies & energies, Eigen::Index tile)
{
  return InRefined.leastWeighedVariance * energies.SquaresDn2().row(tile).mean();
}

Eigen::VectorXd
VariancesOfFrames(const FrameEnergies & energies,
                  const TileLevels &    levels,
                  const VarianceLine &  line,
                  Eigen::Index          tile)
{
  const Eigen::VectorXd level = levels.Of(energies, tile);
  return (line.intercept + line.gain * level.array()).max(LeastVarianceDn2(energies, tile));
}

VarianceCurve
FitFramePhotonTransfer(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & start)
{
  if (energies.Tiles() < static_cast<Eigen::Index>(InCorrelation.leastTiles) || energies.Frames() < 3)
  {
    return {};
  }
  const Regression data(energies, levels);
  VarianceLine     line = start;
  Eigen::MatrixXd  weights;
  for (int round = 0; round < InCommon.roundsOfFit; ++round)
  {
    weights = WeightsBy(data, line);
    line = FitAllTiles(data, weights);
    if (!line.isDetermined)
    {
      return {};
    }
  }
  const FrameSlope found = SlopeOfTiles(data, weights);
  const TileMean & slope = found.ofTiles;
  const double     ofLevels = weights.cwiseProduct(data.ofLevel.cwiseAbs2()).sum();
  if (!(slope.denominators.sum() > InRefined.leastFrameContrast * InRefined.leastFrameContrast * ofLevels) ||
      !(InformationWithoutLargest(data, weights, found) > InRefined.leastInformationWithoutLargest))
  {
    return {};
  }
  line.gain = slope.Value();
  const ValueOfTiles value = ValueAtZero(data, weights, line.gain);
  line.intercept = value.value.Value();
  line.pivotDn = value.pivotDn;
  const double ofSlope = slope.Variance();
  line.covariance << ofSlope, -line.pivotDn * ofSlope, -line.pivotDn * ofSlope,
    line.pivotDn * line.pivotDn * ofSlope + value.value.Variance();
  line.isDetermined = std::isfinite(line.gain) && std::isfinite(line.intercept) && line.covariance.allFinite();
  return CurveOfFrames(data, weights, energies, levels, line);
}

std::size_t
GroupOfFrame(Eigen::Index frame, Eigen::Index frames)
{
  const auto quarter = static_cast<std::size_t>(4 * frame / frames);
  return 2 * quarter + static_cast<std::size_t>(frame % 2);
}

std::vector<TileExcess>
MakeFrameParts(const FrameEnergies & energies, const TileLevels & levels, const PartReference & reference)
{
  const VarianceLine &    line = reference.line;
  const Eigen::Index      frames = energies.Frames();
  std::vector<TileExcess> tiles;
  for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
  {
    const Eigen::VectorXd             level = levels.Of(energies, i);
    const Eigen::ArrayXd              variance = VariancesOfFrames(energies, levels, line, i);
    const Eigen::ArrayXd              shot = (line.gain * (level.array() - reference.blackDn)).max(0.0).min(variance);
    const Eigen::VectorXd             expected = energies.ExpectedSquares(variance.matrix());
    const Eigen::VectorXd             ofShot = energies.ExpectedSquares(shot.matrix());
    const double                      pixels = energies.Pixels()(i);
    std::array<PartSums, FrameGroups> sums;
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      if (energies.RemainingFraction()(t) > InRefined.leastRemainingFraction && expected(t) > 0.0)
      {
        sums[GroupOfFrame(t, frames)] += { pixels,
                                           pixels * level(t),
                                           pixels * energies.SquaresDn2()(i, t),
                                           pixels * expected(t),
                                           pixels * std::clamp(ofShot(t), 0.0, expected(t)),
                                           2.0 * pixels * expected(t) * expected(t) };
      }
    }
    for (std::size_t group = 0; group < FrameGroups; ++group)
    {
      if (sums[group].pixels > 0.0)
      {
        tiles.push_back(sums[group].Excess(reference.varianceInflation));
        tiles.back().phase = group;
      }
    }
  }
  return tiles;
}

} // namespace sensornoise
