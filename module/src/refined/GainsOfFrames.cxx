// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t Quadrants = 4;

/** The excess of the squares of every compared frame in the tiles. */
struct FrameExcess
{
  std::vector<Eigen::Index> frames; ///< the compared frames
  Eigen::MatrixXd ofTiles;          ///< tiles x frames: squares over the line, relative to the tile's mean, minus 1 [1]
  Eigen::VectorXd shot;             ///< fraction of shot noise of each tile [1]
  Eigen::VectorXd error;            ///< sampling error of each tile's values [1]
  Eigen::VectorXd bySlope;          ///< change of the frames' excess by the slope of the line [e-/DN]
  Eigen::VectorXd kept;             ///< fraction of each frame's noise, and so of its excess, in its own squares [1]
};

/** Returns the excess of the frames whose noise is left by more than InRefined.leastRemainingFraction. */
FrameExcess
ExcessOfTiles(const FrameEnergies &   energies,
              const TileLevels &      levels,
              const PartReference &   reference,
              const Eigen::VectorXd & known)
{
  const VarianceLine & line = reference.line;
  FrameExcess          found;
  for (Eigen::Index t = 0; t < energies.Frames(); ++t)
  {
    if (energies.RemainingFraction()(t) > InRefined.leastRemainingFraction)
    {
      found.frames.push_back(t);
    }
  }
  const auto count = static_cast<Eigen::Index>(found.frames.size());
  found.ofTiles.resize(energies.Tiles(), count);
  found.shot.resize(energies.Tiles());
  found.error = (2.0 * reference.varianceInflation / energies.Pixels().array()).sqrt();
  found.bySlope = Eigen::VectorXd::Zero(count);
  found.kept.resize(count);
  for (Eigen::Index k = 0; k < count; ++k)
  {
    found.kept(k) = energies.RemainingFraction()(found.frames[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index i = 0; i < energies.Tiles() && count > 0; ++i)
  {
    const Eigen::VectorXd level = levels.Of(energies, i);
    const Eigen::ArrayXd  variance = VariancesOfFrames(energies, levels, line, i);
    const Eigen::ArrayXd  shot = (line.gain * (level.array() - reference.blackDn)).max(0.0).min(variance);
    const Eigen::VectorXd expected = energies.ExpectedSquares(variance.matrix());
    found.shot(i) = shot.sum() / variance.sum();
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const Eigen::Index t = found.frames[static_cast<std::size_t>(k)];
      const double       ofFrame = known.size() > 0 ? known(t) * found.shot(i) * found.kept(k) : 0.0;
      found.ofTiles(i, k) = energies.SquaresDn2()(i, t) / std::max(smallestDivisor, expected(t)) - ofFrame;
      found.bySlope(k) += (level(t) - level.mean()) / variance(t) / static_cast<double>(energies.Tiles());
    }
    const double mean = found.ofTiles.row(i).mean();
    found.ofTiles.row(i) = found.ofTiles.row(i).array() / std::max(smallestDivisor, mean) - 1.0;
  }
  return found;
}

/** Returns the mean of \a values weighted by shot noise and precision, with Tukey's bisquare about their median. */
double
RobustMean(const std::vector<double> & values, const std::vector<double> & weights, const std::vector<double> & errors)
{
  const double        median = QuantileOf(values, 0.5);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sizes.push_back(std::abs(values[i] - median) / errors[i]);
  }
  const double scale = std::max(1.0, QuantileOf(sizes, 0.5) / MedianOfNormal);
  double       sum = 0.0;
  double       weight = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double near = std::max(0.0, 1.0 - std::pow(sizes[i] / scale / InParts.tukey, 2));
    sum += weights[i] * near * near * values[i];
    weight += weights[i] * near * near;
  }
  return weight > 0.0 ? sum / weight : median;
}

/** Returns the excess of each frame in each quadrant, frames x quadrants; empty: a quadrant has no tiles. */
Eigen::MatrixXd
ExcessOfQuadrants(const FrameExcess & excess, const std::vector<std::size_t> & quadrants)
{
  const Eigen::Index count = excess.ofTiles.cols();
  Eigen::MatrixXd    means(count, static_cast<Eigen::Index>(Quadrants));
  for (Eigen::Index k = 0; k < count; ++k)
  {
    std::array<std::vector<double>, Quadrants> values, weights, errors;
    for (Eigen::Index i = 0; i < excess.ofTiles.rows(); ++i)
    {
      const std::size_t quadrant = quadrants[static_cast<std::size_t>(i)];
      values[quadrant].push_back(excess.ofTiles(i, k));
      weights[quadrant].push_back(excess.shot(i) / (excess.error(i) * excess.error(i)));
      errors[quadrant].push_back(excess.error(i));
    }
    for (std::size_t q = 0; q < Quadrants; ++q)
    {
      if (values[q].empty())
      {
        return {};
      }
      means(k, static_cast<Eigen::Index>(q)) = RobustMean(values[q], weights[q], errors[q]);
    }
  }
  return means;
}

/** The excess of the gain over the excess of the variance that a pattern of frames has, with its error. */
struct GainOfPattern
{
  double value{ 0.0 }; ///< [1]
  double error{ 0.0 }; ///< [1]
};

/** Solves excess = pattern (s a + (1 - s) b) for a, with the prior that a and b differ by InParts.priorOfParts. */
GainOfPattern
FitGain(const FrameExcess & excess, const Eigen::VectorXd & pattern)
{
  const double    square = pattern.squaredNorm();
  const double    prior = 1.0 / (InParts.priorOfParts * InParts.priorOfParts);
  Eigen::Matrix2d normal;
  normal << prior, -prior, -prior, prior;
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < excess.ofTiles.rows(); ++i)
  {
    const double          most = InParts.tukey * excess.error(i);
    const Eigen::ArrayXd  near = (excess.ofTiles.row(i).transpose() - pattern).array().max(-most).min(most);
    const double          slope = 1.0 + pattern.dot(near.matrix()) / square;
    const double          weight = square / (excess.error(i) * excess.error(i));
    const Eigen::Vector2d row(excess.shot(i), 1.0 - excess.shot(i));
    normal += weight * row * row.transpose();
    right += weight * slope * row;
  }
  const Eigen::Matrix2d covariance = normal.inverse();
  return { (covariance * right)(0), std::sqrt(std::max(0.0, covariance(0, 0))) };
}

/** A frame in the order of the gains. */
struct OrderedFrame
{
  std::size_t frame;
  double      excess; ///< [1]
  double      weight; ///< precision of the excess, relative to a frame whose noise is kept [1]
};

/** Returns the weighted mean of the frames from \a begin to \a end - 1, and the weighted sum of squares about it. */
std::pair<double, double>
MeanAndSquares(const std::vector<OrderedFrame> & order, std::size_t begin, std::size_t end)
{
  double weight = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t k = begin; k < end; ++k)
  {
    weight += order[k].weight;
    sum += order[k].weight * order[k].excess;
    squares += order[k].weight * order[k].excess * order[k].excess;
  }
  return { sum / weight, squares - sum * sum / weight };
}

/** Returns the number of frames of the lower of two groups; 0: two gains do not describe the frames. Within the groups,
 * the gains must scatter by chance and what does not count, and between the groups by more. */
std::size_t
DivideFrames(const std::vector<OrderedFrame> & order, double error)
{
  const auto  count = static_cast<double>(order.size());
  std::size_t best = 0;
  double      least = std::numeric_limits<double>::infinity();
  double      distance = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    const auto [below, ofBelow] = MeanAndSquares(order, 0, k);
    const auto [above, ofAbove] = MeanAndSquares(order, k, order.size());
    if (ofBelow + ofAbove < least)
    {
      best = k;
      least = ofBelow + ofAbove;
      distance = above - below;
    }
  }
  const double weight = std::accumulate(
    order.begin(), order.end(), 0.0, [](double sum, const OrderedFrame & own) { return sum + own.weight; });
  const double chance = count * error * error;
  const double most = chance * (1.0 + Significance.hint * std::sqrt(2.0 / count)) +
                      weight * InParts.leastDifference * InParts.leastDifference;
  return least < most && distance > Significance.severalTests * std::sqrt(chance / weight) ? best : 0;
}

/** Fills the groups of two gains. If the gains are not two, gives the frames of the lowest and of the highest gain. */
void
FillGroups(GainsOfFrames & gains, const FrameExcess & compared)
{
  std::vector<OrderedFrame> order;
  for (std::size_t k = 0; k < compared.frames.size(); ++k)
  {
    const double kept = compared.kept(static_cast<Eigen::Index>(k));
    order.push_back({ static_cast<std::size_t>(compared.frames[k]), gains.excess(compared.frames[k]), kept * kept });
  }
  std::stable_sort(
    order.begin(), order.end(), [](const OrderedFrame & a, const OrderedFrame & b) { return a.excess < b.excess; });
  const std::size_t lower = DivideFrames(order, gains.error);
  gains.areGroups = lower > 0;
  if (!gains.areGroups)
  {
    // The outermost frames are so by chance, too.
    const double squared = gains.size * gains.size;
    for (OrderedFrame & own : order)
    {
      own.excess *= squared / (squared + gains.error * gains.error / own.weight);
    }
    const auto [lowest, highest] = std::minmax_element(
      order.begin(), order.end(), [](const OrderedFrame & a, const OrderedFrame & b) { return a.excess < b.excess; });
    gains.groups = { { { lowest->frame }, 1.0 + lowest->excess }, { { highest->frame }, 1.0 + highest->excess } };
    return;
  }
  for (const auto & [begin, end] : { std::pair(std::size_t{ 0 }, lower), std::pair(lower, order.size()) })
  {
    FrameGroup group{ {}, 1.0 + MeanAndSquares(order, begin, end).first };
    for (std::size_t k = begin; k < end; ++k)
    {
      group.frames.push_back(order[k].frame);
    }
    std::sort(group.frames.begin(), group.frames.end());
    gains.groups.push_back(std::move(group));
  }
}

/** Correlation of the excess of quadrants without a common row or column, over the frames. */
struct QuadrantAgreement
{
  double covariance{ 0.0 };
  double z{ 0.0 }; ///< significance, by Fisher's transformation [1]
};

/** Returns the agreement of the columns of \a quadrants. \a dof are the degrees of freedom of a correlation. */
QuadrantAgreement
AgreementOf(const Eigen::MatrixXd & quadrants, double dof)
{
  const Eigen::MatrixXd products = quadrants.transpose() * quadrants;
  const auto            correlation = [&](Eigen::Index a, Eigen::Index b) {
    return products(a, b) / std::sqrt(std::max(smallestDivisor, products(a, a) * products(b, b)));
  };
  const double a = correlation(0, 3);
  const double b = correlation(1, 2);
  // By noise that rows or columns share, the two correlations have the same chance.
  const auto beyond = [&](Eigen::Index k, Eigen::Index l) { return std::max(0.0, correlation(k, l) - 0.5 * (a + b)); };
  const double shared = std::min(1.0, beyond(0, 1) * beyond(2, 3) + beyond(0, 2) * beyond(1, 3));
  const auto   normalOf = [](double r) { return std::atanh(std::clamp(r, -1.0 + 1e-12, 1.0 - 1e-12)); };
  return { 0.5 * (products(0, 3) + products(1, 2)),
           0.5 * (normalOf(a) + normalOf(b)) * std::sqrt(2.0 * dof / (1.0 + shared)) };
}
} // namespace

bool
GainsOfFrames::Differ() const
{
  return DoGainsDiffer(size, z);
}

Eigen::VectorXd
ExcessOfFrames(const PartGains & parts, Eigen::Index count)
{
  Eigen::VectorXd excess(count);
  for (Eigen::Index t = 0; t < count; ++t)
  {
    excess(t) = parts.excess[PartOf(parts.partition, 0.0, 0.0, GroupOfFrame(t, count))];
  }
  return excess;
}

GainsOfFrames
CompareGainsOfFrames(const FrameEnergies &   energies,
                     const TileLevels &      levels,
                     const PartReference &   reference,
                     double                  slopeError,
                     const Eigen::VectorXd & known)
{
  GainsOfFrames     gains;
  const FrameExcess excess = ExcessOfTiles(energies, levels, reference, known);
  Eigen::MatrixXd   quadrants = ExcessOfQuadrants(excess, energies.Quadrants());
  const auto        dof = static_cast<double>(quadrants.rows()) - 4.0; // after mean and slope, for a correlation
  if (!(dof > 0.0) || !quadrants.allFinite())
  {
    return gains;
  }
  const Eigen::VectorXd slope = excess.bySlope.array() - excess.bySlope.mean();
  quadrants.rowwise() -= quadrants.colwise().mean();
  const double ofSlope = slope.dot(quadrants.rowwise().mean()) / std::max(smallestDivisor, slope.squaredNorm());
  const double most = Significance.hint * slopeError;
  quadrants.colwise() -= std::clamp(ofSlope, -most, most) * slope;
  const QuadrantAgreement agreement = AgreementOf(quadrants, dof);
  const Eigen::VectorXd   pattern = quadrants.rowwise().mean();
  const GainOfPattern     scale = FitGain(excess, pattern);
  if (!(agreement.covariance > 0.0 && scale.value > 0.0))
  {
    return gains;
  }
  gains.size = scale.value * std::sqrt(agreement.covariance / excess.kept.squaredNorm());
  gains.z = agreement.z;
  if (!gains.Differ())
  {
    return gains;
  }
  const double chance = std::max(0.0, pattern.squaredNorm() - agreement.covariance);
  gains.error = scale.value * std::sqrt(chance / static_cast<double>(pattern.size()));
  gains.errorOfScale = scale.error / scale.value;
  gains.excess = Eigen::VectorXd::Zero(energies.Frames());
  for (std::size_t k = 0; k < excess.frames.size(); ++k)
  {
    const auto own = static_cast<Eigen::Index>(k);
    gains.excess(excess.frames[k]) = scale.value * pattern(own) / excess.kept(own);
  }
  FillGroups(gains, excess);
  return gains;
}

} // namespace sensornoise
