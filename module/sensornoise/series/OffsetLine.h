/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_series_OffsetLine_h
#define sensornoise_series_OffsetLine_h

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/series/FrameEquations.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameSums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Offset and flicker, from the line on which the frames' changes of light lie. */
struct OffsetLine
{
  double              offset{ 0.0 }; ///< mu minus the centre of the regression [DN]
  double              standardError{ std::numeric_limits<double>::infinity() };
  double              low{ -std::numeric_limits<double>::infinity() }; ///< 95 % interval, may be unbounded
  double              high{ std::numeric_limits<double>::infinity() };
  double              phi{ 1.0 };         ///< dispersion about the line; 1: nothing but noise
  double              flickerZ{ 0.0 };    ///< how far the flicker exceeds its noise, in standard deviations
  double              precision{ 0.0 };   ///< inverse variance of one gamma_t
  double              sensitivity{ 0.0 }; ///< relative change of gamma_t with the offset [1/DN]
  std::vector<double> gamma;              ///< of every frame [1]
  std::size_t         lastClass{ 0 };     ///< roughest gradient class that was admitted

  Eigen::Matrix2d  light;    ///< of the equations that were used
  Eigen::MatrixX2d response; ///< frames x 2

  double
  Widening() const
  {
    return std::max(1.0, phi);
  }

  /** Computes the flicker, v' r_t / v' G v with v = (-m, 1), for the offset \a m (minus the centre). */
  void
  UseOffset(double m)
  {
    const Eigen::Vector2d v(-m, 1.0);
    precision = v.dot(light * v);
    sensitivity = v.dot(light.col(0)) / precision;
    gamma.clear();
    for (Eigen::Index t = 0; t < response.rows(); ++t)
    {
      gamma.push_back(response.row(t).dot(v) / precision);
    }
  }
};

/** Fits the line. With frame t's change of light u_t - mean = a_t + d_t mean, flicker about the offset means
 * a_t = -mu d_t: the maximum over m of
 *
 *     J(m) = sum_t (v' r_t)^2 / (v' G v),   v = (-m, 1),
 *
 * is the maximum-likelihood line with errors in both variables, a generalised eigenvector of sum r r' and G. The
 * second eigenvalue over T - 2 is the dispersion phi, and {m: J(m) >= max J - t^2 phi} the interval, which may be
 * unbounded; t is Student's quantile for T - 2 degrees of freedom. Estimator.md, 3.3. Null if G is not positive. */
inline std::optional<OffsetLine>
FitOffsetLine(const FrameEquations & equations)
{
  const auto                        frames = static_cast<double>(equations.response.rows());
  const Eigen::Matrix2d             energy = equations.response.transpose() * equations.response;
  const Eigen::LLT<Eigen::Matrix2d> factor(equations.light);
  if (factor.info() != Eigen::Success || !energy.allFinite())
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
  line.flickerZ = (larger - (frames - 1.0)) / std::sqrt(2.0 * (frames - 1.0));
  if (!std::isfinite(line.offset))
  {
    return std::nullopt;
  }
  const Eigen::Vector2d v(-line.offset, 1.0);
  line.light = equations.light;
  line.response = equations.response;
  line.UseOffset(line.offset);
  double squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double signal = squares - (frames - 1.0) / line.precision * line.Widening();
  const double across = v.dot(equations.light.col(0));
  const double information = signal * (equations.light(0, 0) - across * across / line.precision);
  if (information > 0.0)
  {
    line.standardError = std::sqrt(line.Widening() / information);
  }
  const double          student = StudentQuantile(0.975, std::max(1.0, frames - 2.0));
  const Eigen::Matrix2d q = energy - (larger - student * student * line.Widening()) * equations.light;
  const double          discriminant = q(0, 1) * q(0, 1) - q(0, 0) * q(1, 1);
  if (q(0, 0) < 0.0 && discriminant > 0.0)
  {
    const double root = std::sqrt(discriminant);
    line.low = (q(0, 1) + root) / q(0, 0);
    line.high = (q(0, 1) - root) / q(0, 0);
  }
  return line;
}

/** The best line over the gradient classes: rougher ones are admitted while they reduce the standard error that the
 * dispersion widens. */
inline std::optional<OffsetLine>
FitOffsetLine(const FrameSums & sums, const RegressorNoise & noise, const std::vector<double> & gamma = {})
{
  std::optional<OffsetLine> best;
  double                    smallest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    const FrameEquations      equations = MakeFrameEquations(sums, noise, c, gamma);
    std::optional<OffsetLine> line = FitOffsetLine(equations);
    if (line)
    {
      const Eigen::Matrix2d & g = equations.light;
      const double            error = std::sqrt(line->Widening() / (g(0, 0) - g(0, 1) * g(0, 1) / g(1, 1)));
      if (error < smallest)
      {
        smallest = error;
        line->lastClass = c;
        best = std::move(line);
      }
    }
  }
  return best;
}

} // namespace sensornoise

#endif
