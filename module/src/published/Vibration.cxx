// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"

#include "base/Eigen.h"
#include "base/Simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace sensornoise
{

double
ChiSquare2Quantile(double level)
{
  if (!(level > 0.0 && level < 1.0))
  {
    throw std::invalid_argument("the level of the vibration test is " + std::to_string(level) +
                                "; expected a probability between 0 and 1");
  }
  return -2.0 * std::log(level);
}

void
TestVibrationOfRow(const double *       mean,
                   std::ptrdiff_t       stride,
                   const double *       variance,
                   const std::uint8_t * valid,
                   std::size_t          count,
                   std::size_t          frames,
                   double               quantile,
                   std::uint8_t *       kept)
{
  const double scale = 2.0 * static_cast<double>(frames);
  for (std::size_t x = 0; x < count; ++x)
  {
    const double * const centre = mean + x;
    const double         dx = 0.5 * (centre[1] - centre[-1]);
    const double         dy = 0.5 * (centre[stride] - centre[-stride]);
    const bool           isStatic = scale * (dx * dx + dy * dy) < quantile * variance[x];
    kept[x] = isStatic && (valid == nullptr || valid[x] != 0) ? 1 : 0;
  }
}

std::vector<std::uint8_t>
VibrationMask(const double *       mean,
              const double *       variance,
              const std::uint8_t * valid,
              std::size_t          width,
              std::size_t          height,
              std::size_t          frames,
              double               level,
              const ParallelFor &  parallelFor)
{
  const double              quantile = ChiSquare2Quantile(level);
  std::vector<std::uint8_t> mask(width * height, 0);
  parallelFor(width > 2 && height > 2 ? height - 2 : 0, [&](std::size_t above) {
    const std::size_t p = (above + 1) * width + 1;
    TestVibrationOfRow(mean + p,
                       static_cast<std::ptrdiff_t>(width),
                       variance + p,
                       valid == nullptr ? nullptr : valid + p,
                       width - 2,
                       frames,
                       quantile,
                       mask.data() + p);
  });
  return mask;
}

namespace
{
using Matrix = Eigen::Matrix<double, 6, 6>;
using Vector = Eigen::Matrix<double, 6, 1>;

/** Maps for the regression. */
struct Maps
{
  const double *       mean;
  const double *       variance;
  const std::uint8_t * valid; ///< null: all pixels are valid
  std::size_t          width;
  std::size_t          height;
};

/** Calls function(p, gradient) in order for the pixels [begin, end) that the regression uses. */
template <typename TFunction>
void
ForInnerPixels(const Maps & maps, std::size_t begin, std::size_t end, TFunction function)
{
  for (std::size_t p = std::max(begin, maps.width); p < std::min(end, maps.width * (maps.height - 1)); ++p)
  {
    const std::size_t x = p % maps.width;
    if (x == 0 || x + 1 == maps.width || (maps.valid != nullptr && maps.valid[p] == 0))
    {
      continue;
    }
    const Gradient gradient = CentredGradient(maps.mean, maps.width, p);
    const bool isFinite = std::isfinite(maps.mean[p]) && std::isfinite(maps.variance[p]) && std::isfinite(gradient.x) &&
                          std::isfinite(gradient.y);
    if (isFinite)
    {
      function(p, gradient);
    }
  }
}

/** Divisors that make the regression's columns of order 1, so that rounding errors of the Gram matrix stay small. */
struct Scales
{
  double      mean{ 0.0 };     ///< largest mean [DN]
  double      gradient{ 0.0 }; ///< largest component of a gradient [DN/pixel]
  std::size_t pixels{ 0 };     ///< number of pixels used
};

Scales
FindScales(const Maps & maps, const ParallelFor & parallelFor)
{
  const auto parts =
    PartsOfBlocks<Scales>(maps.width * maps.height, parallelFor, [&](auto begin, auto end, Scales & part) {
      ForInnerPixels(maps, begin, end, [&](std::size_t p, const Gradient & gradient) {
        ++part.pixels;
        part.mean = std::max(part.mean, std::abs(maps.mean[p]));
        part.gradient = std::max({ part.gradient, std::abs(gradient.x), std::abs(gradient.y) });
      });
    });
  Scales scales;
  for (const Scales & part : parts)
  {
    scales.pixels += part.pixels;
    scales.mean = std::max(scales.mean, part.mean);
    scales.gradient = std::max(scales.gradient, part.gradient);
  }
  return scales;
}

/** \class ProductSums
 * \brief Sums over pixels of the products of the scaled columns 1, u, u^2, gx^2, gy^2 and gx gy with each other and
 * with the variance. A run of pixels is added at a time, with SIMD instructions. */
class ProductSums
{
public:
  static constexpr std::size_t Columns = 7; // number of columns, including the variance
  using Products = std::array<double, Columns * Columns>;

  explicit ProductSums(Products & products)
    : m_Products(products)
  {}

  /** Adds the columns of a pixel to the present run. */
  void
  Add(double u, double gx, double gy, double variance)
  {
    const std::array<double, Columns> row{ 1.0, u, u * u, gx * gx, gy * gy, gx * gy, variance };
    for (std::size_t k = 0; k < Columns; ++k)
    {
      m_Columns[k][m_Pixels] = row[k];
    }
    if (++m_Pixels == PixelsPerRun)
    {
      this->Fold();
    }
  }

  /** Adds the products of the present run, of each column with itself and the next ones. */
  void
  Fold()
  {
    CallWithAvx2([this] {
      for (std::size_t j = 0; j < Columns; ++j)
      {
        for (std::size_t k = j; k < Columns; ++k)
        {
          const double * const one = m_Columns[j].data();
          const double * const other = m_Columns[k].data();
          m_Products[j * Columns + k] += SumOfRun(m_Pixels, [=](std::size_t i) { return one[i] * other[i]; });
        }
      }
    });
    m_Pixels = 0;
  }

private:
  Products &                     m_Products;
  std::array<RunValues, Columns> m_Columns{};
  std::size_t                    m_Pixels{ 0 };
};

/** Returns the coefficients of the scaled columns; null if the scene does not determine all of them. */
std::optional<Vector>
FitCoefficients(const Maps & maps, const Scales & scales, const ParallelFor & parallelFor)
{
  constexpr std::size_t columns = ProductSums::Columns;
  const auto            products = SumBlocks<columns * columns>(
    maps.width * maps.height, parallelFor, [&](std::size_t begin, std::size_t end, ProductSums::Products & block) {
      ProductSums sums(block);
      ForInnerPixels(maps, begin, end, [&](std::size_t p, const Gradient & gradient) {
        sums.Add(
          maps.mean[p] / scales.mean, gradient.x / scales.gradient, gradient.y / scales.gradient, maps.variance[p]);
      });
      sums.Fold();
    });
  using Upper = Eigen::Matrix<double, columns, columns, Eigen::RowMajor>;
  const Eigen::Map<const Upper> upper(products.data());
  const Matrix                  full = upper.topLeftCorner<6, 6>().selfadjointView<Eigen::Upper>();
  const Vector                  right = upper.rightCols<1>().head<6>();
  const Vector                  diagonal = full.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Matrix scaled = diagonal.cwiseInverse().asDiagonal() * full * diagonal.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Matrix> solver(scaled);
  if (solver.rank() != 6)
  {
    return std::nullopt;
  }
  return Vector(solver.solve(right.cwiseQuotient(diagonal)).cwiseQuotient(diagonal));
}
} // namespace

VibrationCovariance
FitVibrationCovariance(const double *       mean,
                       const double *       variance,
                       const std::uint8_t * valid,
                       std::size_t          width,
                       std::size_t          height,
                       double               flickerSd,
                       const ParallelFor &  parallelFor)
{
  const Maps          maps{ mean, variance, valid, width, height };
  const Scales        scales = FindScales(maps, parallelFor);
  VibrationCovariance result;
  result.pixels = scales.pixels;
  if (scales.pixels < 6 || !(scales.mean > 0.0) || !(scales.gradient > 0.0))
  {
    return result;
  }
  const std::optional<Vector> coefficients = FitCoefficients(maps, scales, parallelFor);
  result.isDetermined = coefficients.has_value();
  if (!result.isDetermined)
  {
    return result;
  }
  const Vector & c = *coefficients;
  result.flickerVariance = c(2) / (scales.mean * scales.mean);
  const double flicker = flickerSd >= 0.0 ? flickerSd * flickerSd : std::max(0.0, result.flickerVariance);
  const double unit = (1.0 + flicker) * scales.gradient * scales.gradient;
  result.varianceXPixels2 = c(3) / unit;
  result.varianceYPixels2 = c(4) / unit;
  result.covariancePixels2 = 0.5 * c(5) / unit;
  return result;
}

} // namespace sensornoise
