// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/PolynomialFit.h"

#include "base/Eigen.h"
#include "base/Simd.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

namespace sensornoise
{

namespace
{
/** Sums of the normal equations in x = (mean - centre) / scale, which is within -1 and 1, so that they are well
 * conditioned. They contain the sums of polynomials of lower degree. */
template <int VDegree>
struct NormalSums
{
  std::array<double, 2 * VDegree + 1> moments{};  // sum w x^k
  std::array<double, VDegree + 1>     products{}; // sum w x^k v
  double                              centre{ 0.0 };
  double                              scale{ 1.0 };
  std::size_t                         pixels{ 0 };
  bool                                hasSeveralIntensities{ false }; // whether the pixels have more than one intensity
};

/** Mean and variance of the pixels of a run, 0 for pixels that are not used. */
struct RegressionRun
{
  RunValues mean;
  RunValues variance;
  RunValues has; ///< not 0: the pixel is used

  void
  Take(const RegressionData & data, std::size_t first, std::size_t count)
  {
    std::copy_n(data.mask + first, count, has.begin());
    for (std::size_t i = 0; i < count; ++i)
    {
      const double level = data.mean[first + i];
      const double own = data.variance[first + i];
      const double inMask = has[i];
      const double taken = own - own == 0.0 ? inMask : 0.0; // unlike std::isfinite(), this is vectorized
      has[i] = taken;
      mean[i] = taken != 0.0 ? level : 0.0;
      variance[i] = taken != 0.0 ? own : 0.0;
    }
  }
};

/** Computes the sums over all pixels; \a weight(mean) is the weight of a pixel. */
template <int VDegree, typename TWeight>
NormalSums<VDegree>
SumNormal(const RegressionData & data, const ParallelFor & parallelFor, TWeight weight)
{
  using Sums = NormalSums<VDegree>;
  const ValueRange range = RangeOverPixels(
    data.pixels, parallelFor, [&](std::size_t p) { return data.Has(p); }, [&](std::size_t p) { return data.mean[p]; });
  Sums total;
  total.pixels = range.values;
  total.hasSeveralIntensities = range.highest > range.lowest;
  if (!total.hasSeveralIntensities)
  {
    return total;
  }
  const double centre = 0.5 * (range.lowest + range.highest);
  const double scale = 0.5 * (range.highest - range.lowest);
  const auto   parts = PartsOfBlocks<Sums>(data.pixels, parallelFor, [&](auto begin, auto end, Sums & part) {
    RegressionRun run{};
    RunValues     power{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t count) {
      CallWithAvx2([&] {
        run.Take(data, first, count);
        for (std::size_t i = 0; i < count; ++i)
        {
          const double own = weight(run.mean[i]);
          power[i] = run.has[i] != 0.0 ? own : 0.0;
          run.mean[i] = (run.mean[i] - centre) / scale;
        }
        for (std::size_t k = 0; k < part.moments.size(); ++k)
        {
          part.moments[k] += SumOfRun(count, [&](std::size_t i) { return power[i]; });
          if (k < part.products.size())
          {
            part.products[k] += SumOfRun(count, [&](std::size_t i) { return power[i] * run.variance[i]; });
          }
          std::transform(power.data(), power.data() + count, run.mean.data(), power.data(), std::multiplies<double>());
        }
      });
    });
  });
  for (const Sums & part : parts)
  {
    std::transform(
      part.moments.begin(), part.moments.end(), total.moments.begin(), total.moments.begin(), std::plus<double>());
    std::transform(
      part.products.begin(), part.products.end(), total.products.begin(), total.products.begin(), std::plus<double>());
  }
  total.centre = centre;
  total.scale = scale;
  return total;
}

/** Solves for the polynomial of degree 1 or 2, from sums for this degree or more. */
template <int VDegree, int VDegreeOfSums>
PolynomialFit
Solve(const NormalSums<VDegreeOfSums> & sums)
{
  static_assert(VDegree <= VDegreeOfSums);
  using Matrix = Eigen::Matrix<double, VDegree + 1, VDegree + 1>;
  using Vector = Eigen::Matrix<double, VDegree + 1, 1>;
  PolynomialFit fit;
  fit.pixels = sums.pixels;
  if (fit.pixels <= VDegree || !sums.hasSeveralIntensities)
  {
    return fit;
  }
  Matrix gram;
  Vector right;
  for (int i = 0; i <= VDegree; ++i)
  {
    right(i) = sums.products[static_cast<std::size_t>(i)];
    for (int j = 0; j <= VDegree; ++j)
    {
      gram(i, j) = sums.moments[static_cast<std::size_t>(i + j)];
    }
  }
  const Eigen::LDLT<Matrix> solver(gram);
  const Vector              c = solver.solve(right);
  fit.isDetermined = c.allFinite();
  fit.slope = c(1) / sums.scale;
  fit.intercept = c(0) - c(1) * sums.centre / sums.scale;
  if constexpr (VDegree == 2)
  {
    const Matrix covariance = solver.solve(Matrix::Identity());
    const double scale2 = sums.scale * sums.scale;
    fit.curvature = c(2) / scale2;
    fit.slope -= 2.0 * fit.curvature * sums.centre;
    fit.intercept += fit.curvature * sums.centre * sums.centre;
    fit.curvatureUnitSd = std::sqrt(std::max(0.0, covariance(2, 2))) / scale2;
  }
  return fit;
}

/** Weight of an ordinary regression. */
constexpr auto WeighAlike = [](double /*mean*/) { return 1.0; };

} // namespace

PolynomialFit
FitLine(const RegressionData & data, const ParallelFor & parallelFor)
{
  return Solve<1>(SumNormal<1>(data, parallelFor, WeighAlike));
}

LineAndParabola
FitLineAndParabola(const RegressionData & data, const ParallelFor & parallelFor)
{
  const NormalSums<2> sums = SumNormal<2>(data, parallelFor, WeighAlike);
  return { Solve<1>(sums), Solve<2>(sums) };
}

FitQuality
EvaluateLineFit(const RegressionData & data,
                const PolynomialFit &  line,
                std::size_t            frames,
                const ParallelFor &    parallelFor)
{
  FitQuality quality;
  if (!line.isDetermined)
  {
    return quality;
  }
  const double relativeVariance = 2.0 / static_cast<double>(frames - 1);
  const auto   sumOf = [&](auto term) {
    return SumBlocks<1>(data.pixels, parallelFor, [&](std::size_t begin, std::size_t end, auto & sum) {
      RegressionRun run{};
      ForRuns(begin, end, [&](std::size_t first, std::size_t count) {
        CallWithAvx2([&] {
          run.Take(data, first, count);
          sum[0] += SumOfRun(count, [&](std::size_t i) {
            const double own = term(run.mean[i], run.variance[i]);
            return run.has[i] != 0.0 ? own : 0.0;
          });
        });
      });
    })[0];
  };
  const auto onLine = [&line](double mean) { return line.intercept + line.slope * mean; };
  // Where the line passes zero it does not describe the noise; 1 % of the mean height of the line bounds the weights.
  const double height = sumOf([&](double mean, double) { return onLine(mean); });
  const double lowest = 0.01 * std::abs(height) / static_cast<double>(line.pixels);
  const auto   varianceOf = [&](double mean) { return std::max(lowest, onLine(mean)); };
  const double squares = sumOf([&](double mean, double variance) {
    const double deviation = (variance - onLine(mean)) / varianceOf(mean);
    return deviation * deviation;
  });
  quality.reducedChi2 = squares / relativeVariance / static_cast<double>(line.pixels);
  const PolynomialFit parabola = Solve<2>(SumNormal<2>(data, parallelFor, [&varianceOf](double mean) {
    const double expected = varianceOf(mean);
    return 1.0 / (expected * expected);
  }));
  const double error = parabola.curvatureUnitSd * std::sqrt(relativeVariance * std::max(1.0, quality.reducedChi2));
  if (parabola.isDetermined && error > 0.0)
  {
    quality.curvature = parabola.curvature;
    quality.curvatureZ = parabola.curvature / error;
  }
  return quality;
}

} // namespace sensornoise
