// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"

#include "base/ChiSquare.h"
#include "moments/Constants.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** The energies as a regression: E[squares] = value C + gain X, with C the share of the noise that is left, and X what
 * the levels make. */
struct Regression
{
  explicit Regression(const FrameEnergies & energies, const TileLevels & levels)
    : squares(energies.SquaresDn2())
    , ofConstant(energies.LeftShare())
    , ofLevel(energies.Tiles(), energies.Frames())
    , pixels(energies.Pixels())
  {
    for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
    {
      ofLevel.row(i) = energies.ExpectedSquares(levels.Of(energies.LightDn()(i)).head(energies.Frames())).transpose();
    }
  }

  const Eigen::MatrixXd & squares; ///< tiles x frames
  Eigen::VectorXd         ofConstant;
  Eigen::MatrixXd         ofLevel; ///< tiles x frames [DN]
  const Eigen::VectorXd & pixels;
};

/** The inverse variances of the squares, about: squares of normal values scatter by twice their square. 0 for a frame
 * of which the projection leaves next to nothing. */
Eigen::MatrixXd
WeightsBy(const Regression & data, const VarianceLine & line)
{
  Eigen::MatrixXd weights(data.squares.rows(), data.squares.cols());
  for (Eigen::Index t = 0; t < weights.cols(); ++t)
  {
    const bool isLeft = data.ofConstant(t) > InRefined.leastLeftShare;
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
    {
      const double least = InRefined.leastWeighedVariance * data.squares.row(i).mean() * data.ofConstant(t);
      const double expected = std::max(least, line.intercept * data.ofConstant(t) + line.gain * data.ofLevel(i, t));
      weights(i, t) = isLeft && expected > 0.0 ? 0.5 * data.pixels(i) / (expected * expected) : 0.0;
    }
  }
  return weights;
}

/** One line through the squares of all tiles, to weigh them by. */
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

/** A weighted mean of tiles: sum of the numerators over that of the denominators. */
struct TileMean
{
  Eigen::VectorXd numerators;
  Eigen::VectorXd denominators;

  double
  Value() const
  {
    return numerators.sum() / denominators.sum();
  }
  /** The variance of the mean by the scatter of the tiles, at least that by their weights; wider where tiles are few.
   */
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

/** The slope from frame to frame, tile by tile. */
struct FrameSlope
{
  TileMean        ofTiles;
  Eigen::VectorXd information; ///< what each frame adds to the denominators
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

/** The part of the information on the slope that is left without the fifth of the frames that have most of it [1]: as
 * many may be unlike the others, and a slope that depends on them alone is not identifiable. */
double
ShareOfOthers(const Regression & data, Eigen::MatrixXd weights, const FrameSlope & slope)
{
  std::vector<Eigen::Index> frames(static_cast<std::size_t>(weights.cols()));
  std::iota(frames.begin(), frames.end(), Eigen::Index{ 0 });
  std::stable_sort(frames.begin(), frames.end(), [&](Eigen::Index a, Eigen::Index b) {
    return slope.information(a) > slope.information(b);
  });
  frames.resize(static_cast<std::size_t>(InMoments.largestLeftOutShare * static_cast<double>(weights.cols())));
  for (const Eigen::Index t : frames)
  {
    weights.col(t).setZero();
  }
  return SlopeOfTiles(data, weights).information.sum() / slope.information.sum();
}

/** The variance at level 0 for a slope, and where it is what it is whatever the slope: the pivot. */
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

/** The deviations of the frames from the line, one bin a frame, in the order of their mean levels. Each tile has a
 * constant of its own, as in the slope. */
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
    const Eigen::VectorXd levelsDn = levels.Of(energies.LightDn()(i));
    for (Eigen::Index t = 0; t < weights.cols(); ++t)
    {
      const double weight = weighed(t) * data.ofConstant(t); // of a variance, not of a residual's square
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

TileLevels::TileLevels(const std::vector<double> & gamma, double offsetDn, double zeroDn)
  : m_Illumination(Eigen::Map<const Eigen::VectorXd>(gamma.data(), static_cast<Eigen::Index>(gamma.size())).array() +
                   1.0)
  , m_OffsetDn(offsetDn)
  , m_ZeroDn(zeroDn)
{}

Eigen::VectorXd
TileLevels::Of(double lightDn) const
{
  return m_OffsetDn + m_Illumination.array() * (lightDn + m_ZeroDn - m_OffsetDn);
}

Eigen::VectorXd
VariancesOfFrames(const FrameEnergies & energies,
                  const TileLevels &    levels,
                  const VarianceLine &  line,
                  Eigen::Index          tile)
{
  const Eigen::VectorXd level = levels.Of(energies.LightDn()(tile)).head(energies.Frames());
  const double          least = InRefined.leastWeighedVariance * energies.SquaresDn2().row(tile).mean();
  return (line.intercept + line.gain * level.array()).max(least);
}

VarianceCurve
FitFramePhotonTransfer(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & start)
{
  if (energies.Tiles() < static_cast<Eigen::Index>(InRefined.leastTilesOfTransfer) || energies.Frames() < 3)
  {
    return {};
  }
  const Regression data(energies, levels);
  VarianceLine     line = start;
  Eigen::MatrixXd  weights;
  for (int round = 0; round < InRefined.roundsOfTransfer; ++round)
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
      !(ShareOfOthers(data, weights, found) > InRefined.leastShareOfOthers))
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

} // namespace sensornoise
