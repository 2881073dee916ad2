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
#ifndef sensornoise_published_VibrationCovariance_h
#define sensornoise_published_VibrationCovariance_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/published/VibrationMask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Cov(alpha, beta) of the vibration, with the other coefficients of (2.20). */
struct VibrationCovariance
{
  double      varianceXPixels2{ 0.0 };  ///< of alpha_t, along x [pixel^2]; below 0: none can be seen
  double      varianceYPixels2{ 0.0 };  ///< of beta_t, along y [pixel^2]
  double      covariancePixels2{ 0.0 }; ///< of alpha_t and beta_t [pixel^2]
  double      flickerVariance{ 0.0 };   ///< sigma_gamma^2, the coefficient of the squared mean [1]
  std::size_t pixels{ 0 };
  bool        isDetermined{ false }; ///< false: too few pixels, or a scene without gradients
};

/** Multiple ordinary regression (2.20) of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035):
 *
 *     Var(u) = c0 + c1 ubar + sigma_gamma^2 ubar^2 + (1 + sigma_gamma^2) grad ubar' Cov(alpha, beta) grad ubar
 *
 * over all inner pixels that are \a valid (null: all) and finite, those moved by vibrations included. \a mean [DN] and
 * \a variance [DN^2] are frame-sized maps of the stack as it is, flicker included. \a flickerSd is sigma_gamma where it
 * is known from the flicker itself; below 0: the root of this regression's own coefficient (0 if that is negative). */
inline VibrationCovariance
FitVibrationCovariance(const double *       mean,
                       const double *       variance,
                       const std::uint8_t * valid,
                       std::size_t          width,
                       std::size_t          height,
                       double               flickerSd)
{
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  VibrationCovariance result;
  double              largestMean = 0.0;
  double              largestGradient = 0.0;
  const auto          visit = [&](const auto & function) {
    for (std::size_t y = 1; y + 1 < height; ++y)
    {
      for (std::size_t x = 1; x + 1 < width; ++x)
      {
        const std::size_t p = y * width + x;
        const Gradient    gradient = CentredGradient(mean, width, p);
        const bool isFinite = std::isfinite(mean[p]) && std::isfinite(variance[p]) && std::isfinite(gradient.x) &&
                              std::isfinite(gradient.y);
        if (isFinite && (valid == nullptr || valid[p] != 0))
        {
          function(p, gradient);
        }
      }
    }
  };
  visit([&](std::size_t p, const Gradient & gradient) {
    ++result.pixels;
    largestMean = std::max(largestMean, std::abs(mean[p]));
    largestGradient = std::max({ largestGradient, std::abs(gradient.x), std::abs(gradient.y) });
  });
  if (result.pixels < 6 || !(largestMean > 0.0) || !(largestGradient > 0.0))
  {
    return result;
  }

  // Columns of order 1: the Gram matrix keeps its digits.
  Matrix gram = Matrix::Zero();
  Vector right = Vector::Zero();
  visit([&](std::size_t p, const Gradient & gradient) {
    const double u = mean[p] / largestMean;
    const double gx = gradient.x / largestGradient;
    const double gy = gradient.y / largestGradient;
    Vector       row;
    row << 1.0, u, u * u, gx * gx, gy * gy, gx * gy;
    gram.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right += row * variance[p];
  });
  const Matrix full = gram.selfadjointView<Eigen::Lower>();
  const Vector diagonal = full.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Matrix scaled = diagonal.cwiseInverse().asDiagonal() * full * diagonal.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Matrix> solver(scaled);
  result.isDetermined = solver.rank() == 6;
  if (!result.isDetermined)
  {
    return result;
  }
  const Vector c = solver.solve(right.cwiseQuotient(diagonal)).cwiseQuotient(diagonal);
  result.flickerVariance = c(2) / (largestMean * largestMean);
  const double flicker = flickerSd >= 0.0 ? flickerSd * flickerSd : std::max(0.0, result.flickerVariance);
  const double unit = (1.0 + flicker) * largestGradient * largestGradient;
  result.varianceXPixels2 = c(3) / unit;
  result.varianceYPixels2 = c(4) / unit;
  result.covariancePixels2 = 0.5 * c(5) / unit;
  return result;
}

} // namespace sensornoise

#endif
