// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/PolynomialFit.h"

#include "sensornoise/base/Eigen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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
 * normal equations are well conditioned. Pixels are added in order: the same bits each time. */
template <int VDegree, typename TWeight>
PolynomialFit
FitPolynomial(const RegressionData & data, TWeight weight)
{
  PolynomialFit fit;
  double        lowest = 0.0;
  double        highest = 0.0;
  for (std::size_t p = 0; p < data.pixels; ++p)
  {
    if (data.Has(p))
    {
      lowest = fit.pixels == 0 ? data.mean[p] : std::min(lowest, data.mean[p]);
      highest = fit.pixels == 0 ? data.mean[p] : std::max(highest, data.mean[p]);
      ++fit.pixels;
    }
  }
  if (fit.pixels <= VDegree || !(highest > lowest))
  {
    return fit;
  }
  const double centre = 0.5 * (lowest + highest);
  const double scale = 0.5 * (highest - lowest);

  std::array<double, 2 * VDegree + 1> moments{};  // sum w x^k
  std::array<double, VDegree + 1>     products{}; // sum w x^k v
  for (std::size_t p = 0; p < data.pixels; ++p)
  {
    if (data.Has(p))
    {
      const double x = (data.mean[p] - centre) / scale;
      double       power = weight(data.mean[p]);
      for (std::size_t k = 0; k < moments.size(); ++k, power *= x)
      {
        moments[k] += power;
        if (k < products.size())
        {
          products[k] += power * data.variance[p];
        }
      }
    }
  }
  Solve<VDegree>(moments, products, centre, scale, fit);
  return fit;
}

} // namespace

PolynomialFit
FitLine(const RegressionData & data)
{
  return FitPolynomial<1>(data, [](double) { return 1.0; });
}

PolynomialFit
FitParabola(const RegressionData & data)
{
  return FitPolynomial<2>(data, [](double) { return 1.0; });
}

FitQuality
JudgeLine(const RegressionData & data, const PolynomialFit & line, std::size_t frames)
{
  FitQuality quality;
  if (!line.isDetermined)
  {
    return quality;
  }
  const double relativeVariance = 2.0 / static_cast<double>(frames - 1);
  // Where the line passes zero it says nothing of the noise; 1 % of the line's mean height bounds the weights.
  double height = 0.0;
  for (std::size_t p = 0; p < data.pixels; ++p)
  {
    height += data.Has(p) ? line.intercept + line.slope * data.mean[p] : 0.0;
  }
  const double lowest = 0.01 * std::abs(height) / static_cast<double>(line.pixels);
  const auto varianceOf = [&line, lowest](double mean) { return std::max(lowest, line.intercept + line.slope * mean); };
  double     sum = 0.0;
  for (std::size_t p = 0; p < data.pixels; ++p)
  {
    if (data.Has(p))
    {
      const double expected = varianceOf(data.mean[p]);
      const double deviation = (data.variance[p] - (line.intercept + line.slope * data.mean[p])) / expected;
      sum += deviation * deviation;
    }
  }
  quality.reducedChi2 = sum / relativeVariance / static_cast<double>(line.pixels);
  const PolynomialFit parabola = FitPolynomial<2>(data, [&varianceOf](double mean) {
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
