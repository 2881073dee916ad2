// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/OffsetLine.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "scene/InitialNoiseModel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sensornoise
{

namespace
{
/** Sets the standard error of the offset, from the energy of the flicker above its noise. */
void
SetStandardError(OffsetLine & line, double frames)
{
  const Eigen::Vector2d v(-line.offset, 1.0);
  double                squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double signal = squares - (frames - 1.0) / line.precision * line.Widening();
  const double across = v.dot(line.illumination.col(0));
  const double information = signal * (line.illumination(0, 0) - across * across / line.precision);
  if (information > 0.0)
  {
    line.standardError = std::sqrt(line.Widening() / information);
  }
}

/** Sets the interval {m: J(m) >= max J - t^2 phi}; \a energy is sum r r', \a larger the maximum of J. */
void
SetInterval(OffsetLine & line, const Eigen::Matrix2d & energy, double larger, double frames)
{
  const double          student = StudentQuantile(0.975, std::max(1.0, frames - 2.0));
  const Eigen::Matrix2d q = energy - (larger - student * student * line.Widening()) * line.illumination;
  const double          discriminant = q(0, 1) * q(0, 1) - q(0, 0) * q(1, 1);
  if (q(0, 0) < 0.0 && discriminant > 0.0)
  {
    const double root = std::sqrt(discriminant);
    line.low = (q(0, 1) + root) / q(0, 0);
    line.high = (q(0, 1) - root) / q(0, 0);
  }
}
} // namespace

void
OffsetLine::UseOffset(double m)
{
  const Eigen::Vector2d v(-m, 1.0);
  precision = v.dot(illumination * v);
  sensitivity = v.dot(illumination.col(0)) / precision;
  gamma.clear();
  for (Eigen::Index t = 0; t < response.rows(); ++t)
  {
    gamma.push_back(response.row(t).dot(v) / precision);
  }
}

std::optional<OffsetLine>
FitOffsetLine(const FrameEquations & equations)
{
  const auto                        frames = static_cast<double>(equations.response.rows());
  const Eigen::Matrix2d             energy = equations.response.transpose() * equations.response;
  const Eigen::LLT<Eigen::Matrix2d> factor(equations.illumination);
  if (equations.isLevelMotion || factor.info() != Eigen::Success || !energy.allFinite())
  {
    return std::nullopt;
  }
  const Eigen::Matrix2d                                half = factor.matrixL().solve(energy);
  const Eigen::Matrix2d                                whitened = factor.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(0.5 * (whitened + whitened.transpose()));
  const Eigen::Vector2d                                direction = factor.matrixU().solve(eigen.eigenvectors().col(1));

  OffsetLine   line;
  const double larger = eigen.eigenvalues()(1);
  line.offset = -direction(0) / direction(1);
  line.phi = std::max(0.0, eigen.eigenvalues()(0)) / std::max(1.0, frames - 2.0);
  line.flickerZ = (larger / line.Widening() - (frames - 1.0)) / std::sqrt(2.0 * (frames - 1.0));
  if (!std::isfinite(line.offset))
  {
    return std::nullopt;
  }
  line.illumination = equations.illumination;
  line.response = equations.response;
  line.UseOffset(line.offset);
  SetStandardError(line, frames);
  SetInterval(line, energy, larger, frames);
  return line;
}

namespace
{
double
ContrastOf(const FrameEquations & equations)
{
  return std::clamp(equations.gram(1, 1) / equations.rawGram(1, 1), 0.0, 1.0);
}

/** Returns the flicker of a scene of one level, which does not determine the offset. Null if the offset is at this
 * level, or if the Gram matrix of the level is not positive. */
std::optional<OffsetLine>
LineOfOneLevel(const FrameEquations & equations, double offset)
{
  if (!(equations.illumination(0, 0) > 0.0) || !(offset != 0.0))
  {
    return std::nullopt;
  }
  OffsetLine line;
  line.illumination << equations.illumination(0, 0), 0.0, 0.0, 0.0;
  line.response = equations.response;
  line.offset = offset;
  line.lastClass = GradientClasses - 1;
  line.UseOffset(offset);
  return line;
}

/** Returns the flicker of a ramp, from the changes of its slope. It is consistent with any offset, because a level can
 * be due to motion. */
OffsetLine
LineOfRamp(const FrameEquations & equations, double offset)
{
  OffsetLine line;
  line.illumination = equations.illumination;
  line.response = equations.response;
  line.offset = offset;
  line.contrast = ContrastOf(equations);
  line.lastClass = GradientClasses - 1;
  line.isLevelMotion = true;
  line.UseOffset(offset);
  const auto frames = static_cast<double>(line.gamma.size());
  const auto gamma = Eigen::Map<const Eigen::VectorXd>(line.gamma.data(), equations.response.rows());
  line.flickerZ = (line.precision * gamma.squaredNorm() - (frames - 1.0)) / std::sqrt(2.0 * (frames - 1.0));
  return line;
}

/** Returns the largest significant difference between the offset of \a line and the offsets of the lines of \a fewer
 * gradient classes [DN]; 0: all agree. The pixels of the others are among its own, so that the variance of the
 * difference is the difference of the variances (Hausman 1978, DOI 10.2307/1913827). */
double
DifferenceToFewerClasses(const OffsetLine & line, const std::vector<OffsetLine> & fewer)
{
  double largest = 0.0;
  for (const OffsetLine & other : fewer)
  {
    const double widening = std::max(line.Widening(), other.Widening());
    const double variance = widening * (other.standardError * other.standardError / other.Widening() -
                                        line.standardError * line.standardError / line.Widening());
    const double difference = std::abs(line.offset - other.offset);
    const bool   isSignificant = variance > 0.0 && difference > Significance.oneTest * std::sqrt(variance);
    largest = isSignificant ? std::max(largest, difference) : largest;
  }
  return largest;
}
} // namespace

std::optional<OffsetLine>
FitOffsetLine(const FrameSums &           sums,
              const RegressorNoise &      noise,
              const std::vector<double> & gamma,
              const Eigen::MatrixXd &     without)
{
  std::vector<OffsetLine>   fewer;
  std::optional<OffsetLine> best;
  double                    smallest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    FrameEquations equations = MakeFrameEquations(sums, noise, c, gamma);
    if (without.cols() > 0)
    {
      equations.response -= without * (without.transpose() * equations.response);
    }
    std::optional<OffsetLine> line = FitOffsetLine(equations);
    if (line)
    {
      const Eigen::Matrix2d & g = equations.illumination;
      const double            error = std::sqrt(line->Widening() / (g(0, 0) - g(0, 1) * g(0, 1) / g(1, 1)));
      if (error < smallest)
      {
        smallest = error;
        line->lastClass = c;
        line->contrast = ContrastOf(equations);
        line->differenceOfClassesDn = DifferenceToFewerClasses(*line, fewer);
        best = line;
      }
      fewer.push_back(std::move(*line));
    }
  }
  if (!best)
  {
    const InitialNoiseModel & model = sums.GetRegressors().GetModel();
    const FrameEquations      equations = MakeFrameEquations(sums, noise, GradientClasses - 1, gamma);
    const double              darkest = model.darkestDn - model.centreDn;
    best = equations.isLevelMotion ? LineOfRamp(equations, darkest) : LineOfOneLevel(equations, darkest);
  }
  return best;
}

namespace
{
/** Levels of the frames without signal, for an assumed offset. */
struct DarkLevels
{
  Eigen::VectorXd stepDn; ///< difference of each frame to the middle of the densest half [DN]
  double          errorDn{ 0.0 };
  double          spread{ 0.0 }; ///< standard deviation of the densest half, in units of the error [1]

  double
  UnitDn() const
  {
    return errorDn * std::max(1.0, spread);
  }
};

DarkLevels
LevelsAbout(double offset, const Eigen::MatrixX2d & changes, const Eigen::Matrix2d & covariance)
{
  const Eigen::Vector2d dark(1.0, offset); // level at the centre, and slope
  DarkLevels            levels;
  levels.errorDn = std::sqrt(dark.dot(covariance * dark));
  levels.stepDn = changes * dark;
  std::vector<double> sorted(levels.stepDn.data(), levels.stepDn.data() + levels.stepDn.size());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = (sorted.size() + 1) / 2;
  const std::size_t begin = FindDensestHalf(sorted);
  levels.stepDn.array() -= sorted[begin + half / 2];
  levels.spread = 0.5 * (sorted[begin + half - 1] - sorted[begin]) / MedianOfNormal / levels.errorDn;
  return levels;
}

/** Returns the levels for the possible offsets: a grid over all offsets, and two finer grids about the best offset. */
std::vector<DarkLevels>
LevelsOfOffsets(const ValueRange & offsets, const Eigen::MatrixX2d & changes, const Eigen::Matrix2d & covariance)
{
  std::vector<DarkLevels> found;
  double                  low = offsets.lowest;
  double                  high = offsets.highest;
  double                  best = high;
  double                  least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round)
  {
    const double step = (high - low) / static_cast<double>(InSeries.offsetsTried);
    for (int i = 0; i <= InSeries.offsetsTried; ++i)
    {
      const double offset = low + step * static_cast<double>(i);
      found.push_back(LevelsAbout(offset, changes, covariance));
      if (found.back().spread < least)
      {
        least = found.back().spread;
        best = offset;
      }
    }
    low = std::max(offsets.lowest, best - 2.0 * step);
    high = std::min(offsets.highest, best + 2.0 * step);
  }
  return found;
}
} // namespace

FrameOffsets
FindFrameOffsets(const OffsetLine & line, const ValueRange & offsets, double leastStepDn)
{
  const Eigen::LLT<Eigen::Matrix2d> factor(line.illumination);
  if (line.isLevelMotion || !(line.contrast > InSeries.leastContrast) || factor.info() != Eigen::Success ||
      !(offsets.highest > offsets.lowest))
  {
    return {};
  }
  const Eigen::Matrix2d         covariance = factor.solve(Eigen::Matrix2d::Identity());
  const Eigen::MatrixX2d        changes = line.response * covariance;
  const std::vector<DarkLevels> all = LevelsOfOffsets(offsets, changes, covariance);
  double                        least = std::numeric_limits<double>::infinity();
  for (const DarkLevels & levels : all)
  {
    least = std::min(least, levels.spread);
  }
  Eigen::VectorXd smallest =
    Eigen::VectorXd::Constant(changes.rows(), std::numeric_limits<double>::infinity()); // smallest step over the
                                                                                        // offsets that fit
  Eigen::VectorXd far = smallest;
  for (const DarkLevels & levels : all)
  {
    if (levels.spread <= InSeries.likelyOffset * std::max(1.0, least))
    {
      for (Eigen::Index t = 0; t < smallest.size(); ++t)
      {
        smallest(t) = std::abs(levels.stepDn(t)) < std::abs(smallest(t)) ? levels.stepDn(t) : smallest(t);
      }
      far = far.cwiseMin(levels.stepDn.cwiseAbs() / levels.UnitDn());
    }
  }
  FrameOffsets        found;
  std::vector<double> steps;
  for (Eigen::Index t = 0; t < smallest.size(); ++t)
  {
    const double ofSignal = InSeries.leastStepOfChange * std::abs(changes(t, 1) * offsets.highest);
    if (far(t) > Significance.everyPixel && std::abs(smallest(t)) > std::max(leastStepDn, ofSignal))
    {
      found.unlike.push_back(static_cast<std::size_t>(t));
      steps.push_back(smallest(t));
    }
  }
  found.stepDn = steps.empty() ? 0.0 : QuantileOf(steps, 0.5);
  return found;
}

} // namespace sensornoise
