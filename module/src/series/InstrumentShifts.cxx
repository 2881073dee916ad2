// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"

#include "base/Constants.h"
#include "base/Stencils.h"
#include "series/Constants.h"
#include "series/LocalIllumination.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

namespace
{
using InstrumentGram = FrameSums::InstrumentGram;

/** Largest part of the third central difference D by which a first difference d deviates from the derivative. A
 * band-limited scene has p' = d - D / 6 + ..., because a wave has k = sin k + k^3 / 6 - ... */
constexpr double LargestThirdDifference = 1.0 / 6.0;

/** Returns \a gram, the products of the instruments with the columns, without their common noise. \a variance is the
 * sum of w V over the same pixels, see InstrumentNoise, and \a frames the number of frames. */
InstrumentGram
GramWithoutNoise(InstrumentGram gram, double variance, std::size_t frames)
{
  // The triangle of two boxes of side s has the height 1 / s, and (s - 2) / s^2 two pixels away. A central difference
  // smoothed by it and the plain one have (height - that) / 2 of the noise in common; along the other axis the factor
  // is the height. The value is the same at one pixel and at two, so that the third difference has the same covariance
  // with the other sign.
  const double side = 2.0 * static_cast<double>(InSeries.instrumentRadius) + 1.0;
  const double shared = 0.5 * (1.0 / side - (side - 2.0) / (side * side)) / side;
  const double ofMean = shared * variance / static_cast<double>(frames);
  gram(0, 2 + StencilX) -= ofMean;
  gram(1, 2 + StencilY) -= ofMean;
  gram(0, 2 + StencilXXX) += ofMean;
  gram(1, 2 + StencilYYY) += ofMean;
  return gram;
}

/** Mean and standard deviation of a number that is known to be in an interval [1]. */
struct Bounded
{
  double mean;
  double sd;
};

/** Returns the posterior of a number with a normal estimate, whose prior is uniform between -LargestThirdDifference and
 * 0. */
Bounded
WithinThirdDifferences(double estimate, double standardError)
{
  constexpr int points = 65; // the mean is accurate to a hundredth of the interval, for any standard error
  const double  nearest = std::clamp(estimate, -LargestThirdDifference, 0.0) - estimate;
  double        sum = 0.0;
  double        first = 0.0;
  double        second = 0.0;
  for (int i = 0; i < points; ++i)
  {
    const double value = -LargestThirdDifference * i / (points - 1.0);
    const double off = value - estimate;
    const double weight = std::exp(0.5 * (nearest * nearest - off * off) / (standardError * standardError));
    sum += weight;
    first += weight * value;
    second += weight * value * value;
  }
  if (!(sum > 0.0) || !std::isfinite(sum))
  {
    return { estimate + nearest, 0.0 }; // far narrower than the distance of the points
  }
  const double mean = first / sum;
  return { mean, std::sqrt(std::max(0.0, second / sum - mean * mean)) };
}

/** Returns the coefficient of a third difference divided by the coefficient of the first difference \a k, both over
 * time and without their noise. A band-limited scene has -1/6; a scene interpolated between pixels by cubics has 0.
 * Least squares depends on sharp edges, and exceeds this range. */
Bounded
ThirdDifference(const FrameEquations &      equations,
                const std::vector<double> & gamma,
                double                      offset,
                std::size_t                 k,
                std::size_t                 third)
{
  const Bounded unknown = WithinThirdDifferences(0.0, 1.0);
  const auto    ofThird = static_cast<Eigen::Index>(2 + third);
  if (!(equations.allGram(ofThird, ofThird) > InSeries.leastSignalFraction * equations.allRawGram(ofThird, ofThird)))
  {
    return unknown;
  }
  std::vector<Eigen::Index> columns{ static_cast<Eigen::Index>(2 + k), ofThird };
  for (std::size_t a = 2; a < equations.active.size(); ++a)
  {
    const auto column = static_cast<Eigen::Index>(equations.active[a]);
    if (column != columns[0] && column != columns[1])
    {
      columns.push_back(column);
    }
  }
  const auto      size = static_cast<Eigen::Index>(columns.size());
  const auto      frames = equations.allRight.rows();
  Eigen::MatrixXd gram(size, size);
  Eigen::MatrixXd rawGram(size, size);
  Eigen::MatrixXd right(frames, size);
  for (Eigen::Index i = 0; i < size; ++i)
  {
    const auto   column = columns[static_cast<std::size_t>(i)];
    const double illumination = equations.allGram(column, 1) - offset * equations.allGram(column, 0);
    right.col(i) =
      equations.allRight.col(column) - illumination * Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames);
    for (Eigen::Index j = 0; j < size; ++j)
    {
      gram(i, j) = equations.allGram(column, columns[static_cast<std::size_t>(j)]);
      rawGram(i, j) = equations.allRawGram(column, columns[static_cast<std::size_t>(j)]);
    }
  }
  const Eigen::MatrixXd inverse = gram.inverse();
  const Eigen::MatrixXd coefficients = right * inverse;
  const Eigen::MatrixXd noise = inverse * rawGram * inverse;
  const double          dof = static_cast<double>(frames) - 1.0;
  const double          square = coefficients.col(0).squaredNorm() - dof * noise(0, 0);
  if (!(square > dof * noise(0, 0)))
  {
    return unknown; // more noise than motion
  }
  const double ratio = (coefficients.col(0).dot(coefficients.col(1)) - dof * noise(0, 1)) / square;
  const double residual = (coefficients.col(1) - ratio * coefficients.col(0)).squaredNorm() / dof;
  return WithinThirdDifferences(ratio, std::sqrt(residual / square));
}

/** Returns the covariance of the noise of the sums over a frame: the active columns and, last, the two instruments. */
Eigen::MatrixXd
NoiseOfSums(const FrameEquations & equations, const InstrumentGram & gram, const InstrumentNoise & noise)
{
  const auto      columns = static_cast<Eigen::Index>(equations.active.size());
  Eigen::MatrixXd covariance(columns + 2, columns + 2);
  covariance.topLeftCorner(columns, columns) = equations.rawGram;
  covariance.bottomRightCorner<2, 2>() = noise.squares;
  for (Eigen::Index i = 0; i < columns; ++i)
  {
    const auto column = static_cast<Eigen::Index>(equations.active[static_cast<std::size_t>(i)]);
    covariance.block<1, 2>(i, columns) = gram.col(column).transpose();
    covariance.block<2, 1>(columns, i) = gram.col(column);
  }
  return covariance;
}

/** Returns the shifts along \a axes as a linear function of the sums over a frame, ordered as in NoiseOfSums(): axes x
 * (active columns + 2) [pixel]. The flicker that is subtracted, v' r / v' G v from the sums of the illumination without
 * motion, is linear in the sums, and so are the coefficients of second order.
 * \param gram Gram matrix of the instruments
 * \param inverse inverse of their products with the derivatives, axes x axes
 * \param direction direction of the flicker in the columns 0 and 1 */
Eigen::MatrixXd
ShiftsOfSums(const FrameEquations &  equations,
             const MotionSeries &    motion,
             const Eigen::MatrixXd & gram,
             const Eigen::MatrixXd & inverse,
             const Eigen::Vector2d & direction,
             const Eigen::MatrixXd & instruments)
{
  const auto         columns = static_cast<Eigen::Index>(equations.active.size());
  const auto         size = static_cast<Eigen::Index>(motion.stencils.size());
  Eigen::RowVectorXd flicker = Eigen::RowVectorXd::Zero(columns + 2);
  flicker.head(2) = direction.transpose();
  flicker.segment(2, size) = -(motion.ofIllumination * direction).transpose();
  flicker /= direction.dot(equations.illumination * direction);
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(gram.rows(), columns + 2);
  solution.rightCols<2>() = instruments;
  solution -= gram.leftCols<2>() * direction * flicker;
  for (Eigen::Index i = 0; i < size; ++i)
  {
    const std::size_t k = motion.stencils[static_cast<std::size_t>(i)];
    if (MotionStencils()[k].order == 2)
    {
      Eigen::RowVectorXd coefficient = -motion.ofIllumination.row(i).dot(direction) * flicker;
      coefficient.segment(2, size) += motion.inverseGram.row(i);
      solution -= gram.col(static_cast<Eigen::Index>(2 + k)) * coefficient;
    }
  }
  return inverse * solution;
}

/** Solution of the products of a frame, or of a block of it, with the instruments. */
struct InstrumentSolution
{
  const MotionSeries &        motion;
  const std::vector<double> & gamma;
  Eigen::Vector2d             direction; // direction of the flicker in the columns 0 and 1
  double                      thirdX;    // coefficient of the third difference over the one of the first, see Bounded
  double                      thirdY;

  /** Returns the derivatives of the instruments by shifts along x and y: instruments x axes. */
  Eigen::Matrix2d
  Derivatives(const InstrumentGram & gram) const
  {
    Eigen::Matrix2d derivatives;
    derivatives << gram.col(2 + StencilX) + thirdX * gram.col(2 + StencilXXX),
      gram.col(2 + StencilY) + thirdY * gram.col(2 + StencilYYY);
    return derivatives;
  }

  /** Returns \a sums of frame \a t with the instruments without flicker and second order: the part of the shifts. */
  Eigen::Vector2d
  PartOfShifts(Eigen::Vector2d sums, const InstrumentGram & gram, std::size_t t) const
  {
    sums -= gamma[t] * gram.leftCols<2>() * direction;
    for (std::size_t i = 0; i < motion.stencils.size(); ++i)
    {
      const std::size_t k = motion.stencils[i];
      if (MotionStencils()[k].order == 2)
      {
        sums -= motion.coefficients(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i)) *
                gram.col(static_cast<Eigen::Index>(2 + k));
      }
    }
    return sums;
  }
};

/** Shifts of a block along one axis, beside the shifts of the frame. */
struct BlockShifts
{
  double product{ 0.0 };  ///< product of both series
  double scatter{ 0.0 };  ///< variance of the noise of a shift of the block [pixel^2]
  double variance{ 0.0 }; ///< variance of product, by the noise of each frame (White 1980) [pixel^4]
  double weight{ 0.0 };   ///< derivative of the instrument by the shift
};

/** Returns the deviation of the blocks along one axis, see DeviationOfBlocks. \a square is the sum of the squared
 * shifts of the frame, \a dof their degrees of freedom. The noise of a block is a part of the noise of the frame, in
 * proportion to its weight, and is subtracted from the products. */
DeviationOfBlocks
DeviationAlongAxis(const std::vector<BlockShifts> & blocks, double square, double dof)
{
  const double weights = std::accumulate(
    blocks.begin(), blocks.end(), 0.0, [](double sum, const BlockShifts & block) { return sum + block.weight; });
  const auto noiseOf = [&](const BlockShifts & block) { return dof * block.weight / weights * block.scatter; };
  double     noise = 0.0;
  for (const BlockShifts & block : blocks)
  {
    noise += block.weight / weights * noiseOf(block);
  }
  const double motion = square - noise;
  if (!(motion > noise))
  {
    return {}; // the shifts are mostly noise
  }
  double chi2 = 0.0;
  double squares = 0.0;
  double squaredWeights = 0.0;
  for (const BlockShifts & block : blocks)
  {
    const double deviation = (block.product - noiseOf(block)) / motion - 1.0;
    const double variance = block.variance / (motion * motion);
    chi2 += deviation * deviation / variance;
    squares += block.weight * (deviation * deviation - variance);
    squaredWeights += block.weight * block.weight;
  }
  const auto count = static_cast<double>(blocks.size());
  if (!(chi2 > count + Significance.oneTest * std::sqrt(2.0 * count)))
  {
    return {};
  }
  const double rms = std::sqrt(std::max(0.0, squares / weights));
  return { rms, rms * std::sqrt(squaredWeights) / weights };
}

/** Returns the deviations of the blocks' shifts along x and y from the \a shifts of the frame, weighted by the squared
 * derivatives. A block with more noise than derivatives is left out, and so is the part of the shifts that follows the
 * flicker, as an error of the offset makes it. */
std::array<DeviationOfBlocks, 2>
CompareBlocks(const FrameSums &          sums,
              const InstrumentSolution & solution,
              const InstrumentNoise &    noise,
              const Eigen::MatrixX2d &   shifts)
{
  const auto            frames = static_cast<Eigen::Index>(sums.GetFrame().frames);
  const Eigen::MatrixXd flicker = Orthonormalise(Eigen::Map<const Eigen::VectorXd>(solution.gamma.data(), frames), 1);
  const auto            withoutFlicker = [&flicker](Eigen::MatrixXd series) {
    series.rowwise() -= Eigen::RowVectorXd(series.colwise().mean());
    return Eigen::MatrixXd(series - flicker * (flicker.transpose() * series));
  };
  const Eigen::MatrixXd common = withoutFlicker(shifts);
  const auto            dof = static_cast<double>(frames - 1 - flicker.cols());

  std::array<std::vector<BlockShifts>, 2> ofAxes;
  for (std::size_t block = 0; block < FrameProducts::Blocks; ++block)
  {
    const InstrumentGram & raw = sums.GetInstrumentGram(block);
    const InstrumentGram   gram =
      GramWithoutNoise(raw, sums.FractionOfBlock(block) * noise.variance, sums.GetFrame().frames);
    const Eigen::Matrix2d derivatives = solution.Derivatives(gram);
    Eigen::MatrixX2d      parts(frames, 2);
    for (std::size_t t = 0; t < sums.GetFrame().frames; ++t)
    {
      parts.row(static_cast<Eigen::Index>(t)) =
        solution.PartOfShifts(sums.GetInstrumentSums(t, block), gram, t).transpose();
    }
    for (const Eigen::Index axis : { 0, 1 })
    {
      const double square = common.col(axis).squaredNorm();
      const double weight = derivatives(axis, axis);
      if (weight > InSeries.leastSignalFraction * solution.Derivatives(raw)(axis, axis) && square > 0.0 && dof > 1.0)
      {
        const Eigen::VectorXd own =
          withoutFlicker(parts.col(axis) - derivatives(axis, 1 - axis) * shifts.col(1 - axis)) / weight;
        const double          product = own.dot(common.col(axis));
        const Eigen::VectorXd rest = own - product / square * common.col(axis);
        const double          variance = rest.cwiseProduct(common.col(axis)).squaredNorm();
        const double          more = static_cast<double>(frames) / (dof - 1.0); // for the fitted numbers
        ofAxes[static_cast<std::size_t>(axis)].push_back(
          { product, rest.squaredNorm() / (dof - 1.0), more * variance, weight });
      }
    }
  }
  return { DeviationAlongAxis(ofAxes[0], common.col(0).squaredNorm(), dof),
           DeviationAlongAxis(ofAxes[1], common.col(1).squaredNorm(), dof) };
}

/** Returns the axes whose first derivative is active: rows of the identity, axes x 2. */
Eigen::MatrixXd
ActiveAxes(const FrameEquations & equations)
{
  std::vector<Eigen::Index> axes;
  for (const Eigen::Index axis : { Eigen::Index{ 0 }, Eigen::Index{ 1 } })
  {
    if (equations.Find(static_cast<std::size_t>(2 + axis)))
    {
      axes.push_back(axis);
    }
  }
  Eigen::MatrixXd active = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(axes.size()), 2);
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    active(static_cast<Eigen::Index>(i), axes[i]) = 1.0;
  }
  return active;
}
} // namespace

std::optional<InstrumentShifts>
SolveShifts(const FrameSums &           sums,
            const FrameEquations &      equations,
            const MotionSeries &        motion,
            const InstrumentNoise &     noise,
            const std::vector<double> & gamma,
            double                      offset)
{
  static_assert(StencilX == 0 && StencilY == 1, "the columns of the first derivatives are 2 and 3");
  const Eigen::MatrixXd axes = ActiveAxes(equations);
  if (axes.rows() == 0)
  {
    return std::nullopt;
  }
  const auto               frames = sums.GetFrame().frames;
  const InstrumentGram     ofBoth = GramWithoutNoise(sums.GetInstrumentGram(), noise.variance, frames);
  const Bounded            alongX = ThirdDifference(equations, gamma, offset, StencilX, StencilXXX);
  const Bounded            alongY = ThirdDifference(equations, gamma, offset, StencilY, StencilYYY);
  const Eigen::Vector2d    direction(-offset, 1.0); // direction of the flicker in the columns 0 and 1
  const InstrumentSolution solution{ motion, gamma, direction, alongX.mean, alongY.mean };
  const Eigen::Matrix2d    derivatives = solution.Derivatives(ofBoth);
  const Eigen::MatrixXd    gradient = axes * derivatives * axes.transpose();
  if (!(gradient.diagonal().minCoeff() > 0.0 &&
        gradient.determinant() > InSeries.leastDeterminant * gradient.diagonal().prod()))
  {
    return std::nullopt; // too little of the scene is free of missing pixels
  }
  const Eigen::MatrixXd inverse = gradient.inverse();
  const Eigen::MatrixXd gram = axes * ofBoth;
  InstrumentShifts      shifts;
  shifts.ofIllumination = axes.transpose() * inverse * gram.leftCols<2>();
  shifts.scaleErrors << alongX.sd * std::abs(ofBoth(0, 2 + StencilXXX) / derivatives(0, 0)),
    alongY.sd * std::abs(ofBoth(1, 2 + StencilYYY) / derivatives(1, 1));
  shifts.coefficients.resize(static_cast<Eigen::Index>(frames), 2);
  for (std::size_t t = 0; t < frames; ++t)
  {
    const Eigen::Vector2d part = solution.PartOfShifts(sums.GetInstrumentSums(t), ofBoth, t);
    shifts.coefficients.row(static_cast<Eigen::Index>(t)) = (axes.transpose() * inverse * axes * part).transpose();
  }
  const Eigen::MatrixXd ofSums = NoiseOfSums(equations, sums.GetInstrumentGram(), noise);
  const Eigen::MatrixXd ofShifts = axes.transpose() * ShiftsOfSums(equations, motion, gram, inverse, direction, axes);
  shifts.covariance = ofShifts * ofSums * ofShifts.transpose();
  shifts.ofBlocks = CompareBlocks(sums, solution, noise, shifts.coefficients);
  return shifts;
}

} // namespace sensornoise