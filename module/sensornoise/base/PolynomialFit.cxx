// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/PolynomialFit.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/ValueRange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace sensornoise
{

namespace
{

/** Solves the normal equations in x = (mean - centre) / scale and puts the coefficients of the mean into \a fit.
 * \a moments: sum w x^k; \a products: sum w x^k v. */
template <int VDegree>
void
Solve(const std::array<double, 2 * VDegree + 1> & moments,
      const std::array<double, VDegree + 1> &     products,
      double                                      centre,
      double                                      scale,
      PolynomialFit &                             fit)
{
  using Matrix = Eigen::Matrix<double, VDegree + 1, VDegree + 1>;
  using Vector = Eigen::Matrix<double, VDegree + 1, 1>;
  Matrix gram;
  Vector right;
  for (int i = 0; i <= VDegree; ++i)
  {
    right(i) = products[static_cast<std::size_t>(i)];
    for (int j = 0; j <= VDegree; ++j)
    {
      gram(i, j) = moments[static_cast<std::size_t>(i + j)];
    }
  }
  const Eigen::LDLT<Matrix> solver(gram);
  const Vector              c = solver.solve(right);
  fit.isDetermined = c.allFinite();
  fit.slope = c(1) / scale;
  fit.intercept = c(0) - c(1) * centre / scale;
  if constexpr (VDegree == 2)
  {
    const Matrix covariance = solver.solve(Matrix::Identity());
    fit.curvature = c(2) / (scale * scale);
    fit.slope -= 2.0 * fit.curvature * centre;
    fit.intercept += fit.curvature * centre * centre;
    fit.curvatureUnitSd = std::sqrt(std::max(0.0, covariance(2, 2))) / (scale * scale);
  }
}

/** Least squares of degree 1 or 2; \a weight(mean) weighs a pixel. The abscissa is centred and scaled, so that the
 * normal equations are well conditioned. */
template <int VDegree, typename TWeight>
PolynomialFit
FitPolynomial(const RegressionData & data, const ParallelFor & parallelFor, TWeight weight)
{
  PolynomialFit    fit;
  const ValueRange range = RangeOverPixels(
    data.pixels, parallelFor, [&](std::size_t p) { return data.Has(p); }, [&](std::size_t p) { return data.mean[p]; });
  fit.pixels = range.values;
  if (fit.pixels <= VDegree || !(range.highest > range.lowest))
  {
    return fit;
  }
  const double centre = 0.5 * (range.lowest + range.highest);
  const double scale = 0.5 * (range.highest - range.lowest);

  struct Sums
  {
    std::array<double, 2 * VDegree + 1> moments;  // sum w x^k
    std::array<double, VDegree + 1>     products; // sum w x^k v
  };
  const auto parts = PartsOfBlocks<Sums>(data.pixels, parallelFor, [&](auto begin, auto end, Sums & part) {
    Sums own{}; // in registers
    for (std::size_t p = begin; p < end; ++p)
    {
      if (data.Has(p))
      {
        const double x = (data.mean[p] - centre) / scale;
        double       power = weight(data.mean[p]);
        for (std::size_t k = 0; k < own.moments.size(); ++k, power *= x)
        {
          own.moments[k] += power;
          if (k < own.products.size())
          {
            own.products[k] += power * data.variance[p];
          }
        }
      }
    }
    part = own;
  });
  Sums       total{};
  for (const Sums & part : parts)
  {
    std::transform(
      part.moments.begin(), part.moments.end(), total.moments.begin(), total.moments.begin(), std::plus<double>());
    std::transform(
      part.products.begin(), part.products.end(), total.products.begin(), total.products.begin(), std::plus<double>());
  }
  Solve<VDegree>(total.moments, total.products, centre, scale, fit);
  return fit;
}

} // namespace

PolynomialFit
FitLine(const RegressionData & data, const ParallelFor & parallelFor)
{
  return FitPolynomial<1>(data, parallelFor, [](double) { return 1.0; });
}

PolynomialFit
FitParabola(const RegressionData & data, const ParallelFor & parallelFor)
{
  return FitPolynomial<2>(data, parallelFor, [](double) { return 1.0; });
}

FitQuality
JudgeLine(const RegressionData & data, const PolynomialFit & line, std::size_t frames, const ParallelFor & parallelFor)
{
  FitQuality quality;
  if (!line.isDetermined)
  {
    return quality;
  }
  const double relativeVariance = 2.0 / static_cast<double>(frames - 1);
  const auto   sumOf = [&](auto term) {
    return SumOverBlocks<1>(data.pixels, parallelFor, [&](std::size_t p, auto & sum) {
      sum[0] += data.Has(p) ? term(data.mean[p], data.variance[p]) : 0.0;
    })[0];
  };
  const auto onLine = [&line](double mean) { return line.intercept + line.slope * mean; };
  // Where the line passes zero it says nothing of the noise; 1 % of the line's mean height bounds the weights.
  const double height = sumOf([&](double mean, double) { return onLine(mean); });
  const double lowest = 0.01 * std::abs(height) / static_cast<double>(line.pixels);
  const auto   varianceOf = [&](double mean) { return std::max(lowest, onLine(mean)); };
  const double squares = sumOf([&](double mean, double variance) {
    const double deviation = (variance - onLine(mean)) / varianceOf(mean);
    return deviation * deviation;
  });
  quality.reducedChi2 = squares / relativeVariance / static_cast<double>(line.pixels);
  const PolynomialFit parabola = FitPolynomial<2>(data, parallelFor, [&varianceOf](double mean) {
    const double expected = varianceOf(mean);
    return 1.0 / (expected * expected);
  });
  const double error = parabola.curvatureUnitSd * std::sqrt(relativeVariance * std::max(1.0, quality.reducedChi2));
  if (parabola.isDetermined && error > 0.0)
  {
    quality.curvature = parabola.curvature;
    quality.curvatureZ = parabola.curvature / error;
  }
  return quality;
}

} // namespace sensornoise
