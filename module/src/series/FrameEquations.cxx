// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"

#include "base/Constants.h"
#include "base/Stencils.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns the contribution to the Gram matrix of white noise of variance 1 in the mean. */
FrameSums::ClassMatrix
KernelGram()
{
  const auto &           stencils = MotionStencils();
  FrameSums::ClassMatrix kernels = FrameSums::ClassMatrix::Zero();
  kernels(1, 1) = 1.0;
  for (std::size_t i = 0; i < NumberOfStencils; ++i)
  {
    const auto row = static_cast<Eigen::Index>(2 + i);
    kernels(1, row) = kernels(row, 1) = stencils[i].CentreWeight();
    for (std::size_t j = 0; j < NumberOfStencils; ++j)
    {
      kernels(row, static_cast<Eigen::Index>(2 + j)) = InnerProduct(stencils[i], stencils[j]);
    }
  }
  return kernels;
}

Eigen::MatrixXd
Select(const Eigen::MatrixXd & matrix, const std::vector<std::size_t> & rows, const std::vector<std::size_t> & columns)
{
  Eigen::MatrixXd part(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
        matrix(static_cast<Eigen::Index>(rows[i]), static_cast<Eigen::Index>(columns[j]));
    }
  }
  return part;
}

/** Returns the columns 0 and 1, and the derivatives whose signal exceeds their noise. */
std::vector<std::size_t>
FindCandidates(const Eigen::MatrixXd & rawGram, const Eigen::MatrixXd & gram, int largestOrder)
{
  const auto &             stencils = MotionStencils();
  std::vector<std::size_t> active{ 0, 1 };
  for (std::size_t k = 2; k < FrameColumns; ++k)
  {
    const auto i = static_cast<Eigen::Index>(k);
    if (stencils[k - 2].order <= largestOrder && gram(i, i) > InSeries.leastSignalFraction * rawGram(i, i))
    {
      active.push_back(k);
    }
  }
  return active;
}

/** Returns the least fraction by which a column must differ from the first derivatives in \a active. Their noise leaves
 * a statistical error in the Gram matrix: relative to their signal, sqrt(3 / pixels) of the noise, because neighbours
 * have half of their noise in common. */
double
LeastDistinctFraction(const Eigen::MatrixXd &          rawGram,
                      const Eigen::MatrixXd &          gram,
                      const std::vector<std::size_t> & active,
                      double                           pixels)
{
  double noise = 0.0;
  for (const std::size_t k : active)
  {
    if (k >= 2 && MotionStencils()[k - 2].order == 1)
    {
      const auto i = static_cast<Eigen::Index>(k);
      noise += (rawGram(i, i) - gram(i, i)) / gram(i, i);
    }
  }
  return std::max(InSeries.leastDistinctFraction,
                  noise > 0.0 ? Significance.severalTests * noise * std::sqrt(3.0 / pixels) : 0.0);
}

/** Removes the weaker of the first derivatives if both are proportional: then only motion along the gradient is
 * identifiable. */
void
RemoveProportionalDerivative(const Eigen::MatrixXd &    rawGram,
                             const Eigen::MatrixXd &    gram,
                             double                     pixels,
                             std::vector<std::size_t> & active)
{
  constexpr auto x = static_cast<Eigen::Index>(2 + StencilX);
  constexpr auto y = static_cast<Eigen::Index>(2 + StencilY);
  const auto     isActive = [&](Eigen::Index k) {
    return std::find(active.begin(), active.end(), static_cast<std::size_t>(k)) != active.end();
  };
  if (isActive(x) && isActive(y) &&
      1.0 - gram(x, y) * gram(x, y) / (gram(x, x) * gram(y, y)) < LeastDistinctFraction(rawGram, gram, active, pixels))
  {
    const auto weaker = static_cast<std::size_t>(gram(x, x) < gram(y, y) ? x : y);
    active.erase(std::remove(active.begin(), active.end(), weaker), active.end());
  }
}

/** Returns the smallest eigenvalue of the matrix whose rows and columns are scaled to a diagonal of 1. */
double
SmallestEigenvalue(const Eigen::MatrixXd & a)
{
  const Eigen::VectorXd unit = a.diagonal().array().abs().max(1e-300).rsqrt();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(unit.asDiagonal() * a * unit.asDiagonal()).eigenvalues()(0);
}

/** Expected contribution of noise to the series of a column, and its standard deviation: for the sum of squares over
 * the frames, in units of the variance at the mean illumination. */
class SeriesEnergy
{
public:
  /** \a gamma: relative illumination of the frames minus 1, from the regression [1]. If it hardly changes, all frames
   * have equal noise. Otherwise the noise is taken as shot noise, proportional to 1 + gamma. A component that follows
   * gamma is then no motion. It is in the basis, and the noise of bright frames is more strongly correlated with the
   * mean than the noise of dark frames. */
  explicit SeriesEnergy(const Eigen::VectorXd & gamma)
    : m_Expected(static_cast<double>(gamma.size() - 1))
    , m_Spread(std::sqrt(2.0 * m_Expected))
  {
    if (gamma.cwiseAbs().maxCoeff() > InSeries.equalFrameNoise)
    {
      const auto frames = static_cast<double>(gamma.size());
      m_Known.resize(gamma.size(), 2);
      m_Known.col(0).setConstant(1.0 / std::sqrt(frames));
      m_Known.col(1) = (gamma.array() - gamma.mean()).matrix().normalized();
      const Eigen::VectorXd variance = (1.0 + gamma.array()).max(0.0);
      const Eigen::VectorXd leverage = m_Known.cwiseAbs2().rowwise().sum();
      m_Expected = variance.dot(Eigen::VectorXd(1.0 - leverage.array()));
      m_Spread = std::sqrt(2.0 * (variance.cwiseAbs2().dot(Eigen::VectorXd(1.0 - 2.0 * leverage.array())) +
                                  (m_Known.transpose() * variance.asDiagonal() * m_Known).squaredNorm()));
    }
  }

  /** Returns the number of standard deviations by which a \a series exceeds noise of \a variance. */
  double
  Significance(const Eigen::VectorXd & series, double variance) const
  {
    const double ofGamma = m_Known.cols() > 0 ? std::pow(m_Known.col(1).dot(series), 2) : 0.0;
    return ((series.squaredNorm() - ofGamma) / variance - m_Expected) / m_Spread;
  }

private:
  Eigen::MatrixXd m_Known; ///< the constant and gamma, orthonormal; empty if all frames have equal noise
  double          m_Expected;
  double          m_Spread;
};

/** Returns the place among the active columns of the column of higher order whose series over the frames is the least
 * significant, the third order first; 0 if all are significant. */
std::size_t
FindInsignificant(const Eigen::MatrixXd &          rawGram,
                  const Eigen::MatrixXd &          a,
                  const Eigen::MatrixXd &          right,
                  const std::vector<std::size_t> & active)
{
  const auto &          stencils = MotionStencils();
  const Eigen::MatrixXd inverse = a.inverse();
  const Eigen::VectorXd variance = (inverse * Select(rawGram, active, active) * inverse).diagonal();
  const auto            coefficients = [&](std::size_t k) {
    Eigen::VectorXd series = Eigen::VectorXd::Zero(right.rows());
    for (std::size_t j = 0; j < active.size(); ++j)
    {
      series += inverse(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) *
                right.col(static_cast<Eigen::Index>(active[j]));
    }
    return series;
  };
  const SeriesEnergy energy(coefficients(1));
  std::size_t        worst = 0;
  double             worstScore = 0.0;
  for (std::size_t k = 2; k < active.size(); ++k)
  {
    const int order = stencils[active[k] - 2].order;
    if (order > 1)
    {
      const double z = energy.Significance(coefficients(k), variance(static_cast<Eigen::Index>(k)));
      const double score = z - (order == 3 ? 100.0 : 0.0);
      if (z < Significance.severalTests && (worst == 0 || score < worstScore))
      {
        worst = k;
        worstScore = score;
      }
    }
  }
  return worst;
}

/** Returns the columns that the data support. The first order needs a signal that exceeds its noise; higher orders also
 * need a significant series over the frames. Insignificant columns are eliminated one by one, the third order first. */
std::vector<std::size_t>
FindActiveColumns(const Eigen::MatrixXd & rawGram,
                  const Eigen::MatrixXd & gram,
                  const Eigen::MatrixXd & right,
                  int                     largestOrder,
                  double                  pixels)
{
  std::vector<std::size_t> active = FindCandidates(rawGram, gram, largestOrder);
  RemoveProportionalDerivative(rawGram, gram, pixels, active);
  for (;;)
  {
    const Eigen::MatrixXd a = Select(gram, active, active);
    std::size_t           worst = 0;
    if (SmallestEigenvalue(a) > 1e-6)
    {
      worst = FindInsignificant(rawGram, a, right, active);
    }
    else if (active.size() > 2 && MotionStencils()[active.back() - 2].order > 1)
    {
      worst = active.size() - 1;
    }
    if (worst == 0)
    {
      return active;
    }
    active.erase(active.begin() + static_cast<std::ptrdiff_t>(worst));
  }
}

/** Sets the equations of the illumination, with the motion partialled out. Returns the matrix that subtracts the
 * motion from the right-hand sides. */
Eigen::MatrixX2d
PartialOutMotion(FrameEquations & equations)
{
  const auto motion = static_cast<Eigen::Index>(equations.active.size() - 2);
  equations.illumination = equations.gram.topLeftCorner<2, 2>();
  Eigen::MatrixX2d without = Eigen::MatrixX2d::Identity(2 + motion, 2);
  if (motion > 0)
  {
    const Eigen::MatrixXd partial =
      equations.gram.bottomRightCorner(motion, motion).ldlt().solve(equations.gram.bottomLeftCorner(motion, 2));
    equations.illumination -= equations.gram.topRightCorner(2, motion) * partial;
    without.bottomRows(motion) = -partial;
  }
  equations.response = equations.right * without;
  return without;
}

/** Removes the level from the equations of the illumination, where it cannot be distinguished from motion. */
void
RemoveLevel(FrameEquations & equations, double leastFraction)
{
  Eigen::Matrix2d & illumination = equations.illumination;
  equations.isLevelMotion = equations.active.size() > 2 &&
                            !(illumination(0, 0) > leastFraction * equations.gram(0, 0)) && illumination(1, 1) > 0.0;
  if (equations.isLevelMotion)
  {
    illumination(0, 0) = illumination(0, 1) = illumination(1, 0) = 0.0;
    equations.response.col(0).setZero();
  }
}

/** Weights the equations of the illumination by the \a covariance of their right-hand sides. */
void
WeightByCovariance(FrameEquations & equations, Eigen::Matrix2d covariance)
{
  if (equations.isLevelMotion)
  {
    covariance(0, 1) = covariance(1, 0) = 0.0; // column 1 alone is left
  }
  const Eigen::LLT<Eigen::Matrix2d> factor(covariance);
  if (factor.info() == Eigen::Success && covariance.allFinite())
  {
    const Eigen::Matrix2d weighted = factor.solve(equations.illumination);
    const Eigen::Matrix2d product = equations.illumination * weighted;
    equations.response = (equations.response * weighted).eval();
    // It is symmetric. Clang 14 gives another lower element for WebAssembly.
    equations.illumination << product(0, 0), product(0, 1), product(0, 1), product(1, 1);
  }
}
} // namespace

std::optional<std::size_t>
FrameEquations::Find(std::size_t column) const
{
  const auto found = std::find(active.begin(), active.end(), column);
  return found == active.end() ? std::nullopt : std::optional<std::size_t>(found - active.begin());
}

FrameEquations
MakeFrameEquations(const FrameSums &           sums,
                   const RegressorNoise &      noise,
                   std::size_t                 lastClass,
                   const std::vector<double> & gamma)
{
  const auto      frames = sums.GetFrame().frames;
  const auto &    stencils = MotionStencils();
  Eigen::MatrixXd rawGram = Eigen::MatrixXd::Zero(FrameColumns, FrameColumns);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(frames), FrameColumns);
  Eigen::MatrixXd ofProducts = Eigen::MatrixXd::Zero(FrameColumns, FrameColumns);
  double          variance = 0.0;
  double          shot = 0.0;
  for (std::size_t c = 0; c <= lastClass; ++c)
  {
    rawGram += sums.GetClassGram(c);
    variance += noise.variance[c] / static_cast<double>(frames);
    shot += noise.shot[c] / static_cast<double>(frames);
    if (!noise.ofProducts.empty())
    {
      ofProducts += noise.ofProducts[c];
    }
    for (std::size_t t = 0; t < frames; ++t)
    {
      right.row(static_cast<Eigen::Index>(t)) += sums.GetClassSums(t, c).transpose();
    }
  }
  const Eigen::MatrixXd gram = rawGram - variance * KernelGram();
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    for (std::size_t k = 1; k < FrameColumns; ++k)
    {
      const double centre = k == 1 ? 1.0 : stencils[k - 2].CentreWeight();
      right(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) -= gamma[t] * centre * shot;
    }
  }

  const double pixels = variance * static_cast<double>(frames); // approximately: variances have been divided by the
                                                                // variances of the model
  FrameEquations equations;
  equations.active = FindActiveColumns(rawGram, gram, right, frames < InSeries.framesForThirdOrder ? 2 : 3, pixels);
  std::vector<std::size_t> rows(frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    rows[t] = t;
  }
  equations.rawGram = Select(rawGram, equations.active, equations.active);
  equations.gram = Select(gram, equations.active, equations.active);
  equations.right = Select(right, rows, equations.active);
  const Eigen::MatrixX2d without = PartialOutMotion(equations);
  RemoveLevel(equations, LeastDistinctFraction(rawGram, gram, equations.active, pixels));
  if (!noise.ofProducts.empty())
  {
    const Eigen::MatrixXd covariance = Select(ofProducts, equations.active, equations.active);
    WeightByCovariance(equations, without.transpose() * covariance * without);
  }
  equations.allRawGram = rawGram;
  equations.allGram = gram;
  equations.allRight = std::move(right);
  return equations;
}

} // namespace sensornoise
