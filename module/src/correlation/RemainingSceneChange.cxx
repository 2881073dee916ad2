// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"

#include "base/Eigen.h"
#include "correlation/CorrelationSums.h"
#include "correlation/LagSums.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sums of a regression over pairs of neighbours: y is their noise covariance, x the product of their slopes, both
 * relative to the variance. */
struct SlopeSums
{
  double xx{ 0.0 }; ///< sum of the squares of x, less the mean of x for a lag in a tile
  double xy{ 0.0 };
  double pixels{ 0.0 };
  double roughness{ 0.0 }; ///< squared slope over the variance

  SlopeSums &
  operator+=(const SlopeSums & other)
  {
    xx += other.xx;
    xy += other.xy;
    pixels += other.pixels;
    roughness += other.roughness;
    return *this;
  }
};

/** Returns the slopes of the signal along x and y at the inner pixels of a tile, over the standard deviation of the
 * noise; 0 at the other pixels. */
Eigen::ArrayX2d
SlopesOf(const NoiseResiduals & residuals, std::size_t tile)
{
  const std::size_t   side = residuals.GetTiles().side;
  const float * const signal = residuals.SignalOf(tile);
  const float * const weight = residuals.WeightOf(tile);
  Eigen::ArrayX2d     slopes = Eigen::ArrayX2d::Zero(static_cast<Eigen::Index>(side * side), 2);
  for (std::size_t y = 1; y + 1 < side; ++y)
  {
    for (std::size_t x = 1; x + 1 < side; ++x)
    {
      const std::size_t p = y * side + x;
      const double      root = std::sqrt(static_cast<double>(weight[p]));
      slopes.row(static_cast<Eigen::Index>(p)) << 0.5 * root * (static_cast<double>(signal[p + 1]) - signal[p - 1]),
        0.5 * root * (static_cast<double>(signal[p + side]) - signal[p - side]);
    }
  }
  return slopes;
}

SlopeSums
SumsOf(const NoiseResiduals & residuals, std::size_t tile)
{
  const std::vector<Lag> lags{ { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
  const auto             products = SumProducts(residuals, tile, lags);
  const Eigen::ArrayX2d  slopes = SlopesOf(residuals, tile);
  const float * const    weight = residuals.WeightOf(tile);
  const std::size_t      side = residuals.GetTiles().side;
  const double           inverseDof = 1.0 / residuals.GetDof();
  SlopeSums              sums;
  sums.roughness = slopes.square().sum();
  sums.pixels = static_cast<double>((slopes.square().rowwise().sum() > 0.0).count());
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t row = 1; row + 2 < side; ++row)
    {
      for (std::size_t column = 2; column + 2 < side; ++column)
      {
        const std::size_t p = row * side + column;
        const std::size_t q = p + static_cast<std::size_t>(lags[k].y) * side +
                              static_cast<std::size_t>(static_cast<std::ptrdiff_t>(lags[k].x));
        const double root = std::sqrt(static_cast<double>(weight[p]) * weight[q]);
        if (root > 0.0)
        {
          x.push_back((slopes.row(static_cast<Eigen::Index>(p)) * slopes.row(static_cast<Eigen::Index>(q))).sum());
          y.push_back(inverseDof * static_cast<double>(products[k][p]) * root);
        }
      }
    }
    if (x.empty())
    {
      continue;
    }
    const auto                       count = static_cast<Eigen::Index>(x.size());
    Eigen::Map<const Eigen::ArrayXd> ofX(x.data(), count);
    const Eigen::VectorXd            own = ofX - ofX.mean();
    sums.xx += own.squaredNorm();
    sums.xy += own.dot(Eigen::Map<const Eigen::VectorXd>(y.data(), count));
  }
  return sums;
}
} // namespace

MeasuredNumber
FindLocalMotion(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<SlopeSums> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumsOf(residuals, i); });
  const JackknifeEstimate estimate = Jackknife(tiles, [](const SlopeSums & all) {
    const bool isIdentifiable = all.xx > 0.0 && all.pixels > 0.0;
    return Eigen::VectorXd(
      Eigen::VectorXd::Constant(1, isIdentifiable ? all.xy / all.xx * all.roughness / all.pixels : 0.0));
  });
  return { estimate.value(0), estimate.StandardError(0) };
}

namespace
{
/** Segments of a line in one tile. Segments that are not adjacent have no short-range noise correlation. */
constexpr std::size_t PartsOfTile = 4;
/** Approximate number of blocks of lines for the jackknife. */
constexpr std::size_t Blocks = 24;

/** Products of sums over two segments of a line, where y is a residual, w = 1 / V, and z the signal. The covariance of
 * two pixels is a constant plus a coefficient times the product of their signals. */
struct LineIlluminationProducts
{
  double noise{ 0.0 };       ///< products of sums of w y
  double constant{ 0.0 };    ///< products of sums of w: the constant's own normal equation
  double mixed{ 0.0 };       ///< products of sums of w z: couples both normal equations
  double signalNoise{ 0.0 }; ///< products of sums of w z y
  double square{ 0.0 };      ///< products of sums of w z^2: the coefficient's own normal equation

  LineIlluminationProducts &
  operator+=(const LineIlluminationProducts & other)
  {
    noise += other.noise;
    constant += other.constant;
    mixed += other.mixed;
    signalNoise += other.signalNoise;
    square += other.square;
    return *this;
  }

  /** Returns the coefficient of the product of the signals [1]; NaN where it is not identifiable. */
  double
  OfIllumination() const
  {
    const double determinant = constant * square - mixed * mixed;
    return determinant > InCorrelation.leastSpread * constant * square
             ? (constant * signalNoise - mixed * noise) / determinant
             : std::numeric_limits<double>::quiet_NaN();
  }
};

/** Returns the sum of the products of all pairs of segments that are not adjacent. */
double
ProductOfParts(const std::vector<double> & sums)
{
  double product = 0.0;
  double before = 0.0; // sum over all segments before the adjacent one
  for (std::size_t s = 2; s < sums.size(); ++s)
  {
    before += sums[s - 2];
    product += sums[s] * before;
  }
  return product;
}

/** Returns the number of pixels of a line in a part of a tile. */
std::size_t
PixelsOfPart(const SampleTiles & tiles)
{
  return tiles.side / PartsOfTile;
}

/** A pixel of a line, with its weight \a w = 1 / V [1/DN^2] and signal \a z [DN]. */
struct PixelOfLine
{
  std::size_t tile;
  std::size_t inTile;
  double      w;
  double      z;
};

/** Returns the pixels of line \a line of \a tiles, which lie side by side, in the order of the frame. Each part of a
 * tile has PixelsOfPart() of them. */
std::vector<PixelOfLine>
PixelsOfLine(const NoiseResiduals & residuals, const std::vector<std::size_t> & tiles, LineAxis axis, std::size_t line)
{
  const SampleTiles &      of = residuals.GetTiles();
  std::vector<PixelOfLine> pixels;
  pixels.reserve(tiles.size() * of.side);
  for (const std::size_t tile : tiles)
  {
    for (std::size_t k = 0; k < PartsOfTile * PixelsOfPart(of); ++k)
    {
      const std::size_t p = of.InTile(axis, line, k);
      pixels.push_back({ tile,
                         p,
                         static_cast<double>(residuals.WeightOf(tile)[p]),
                         static_cast<double>(residuals.SignalOf(tile)[p]) });
    }
  }
  return pixels;
}

LineIlluminationProducts
ProductsOfLine(const NoiseResiduals & residuals, const std::vector<PixelOfLine> & pixels)
{
  const std::size_t   length = PixelsOfPart(residuals.GetTiles());
  const std::size_t   parts = pixels.size() / length;
  std::vector<double> constant(parts, 0.0);
  std::vector<double> mixed(parts, 0.0);
  std::vector<double> square(parts, 0.0);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const auto & [tile, inTile, w, z] = pixels[i];
    constant[i / length] += w;
    mixed[i / length] += w * z;
    square[i / length] += w * z * z;
  }
  LineIlluminationProducts products;
  products.constant = ProductOfParts(constant);
  products.mixed = ProductOfParts(mixed);
  products.square = ProductOfParts(square);
  std::vector<double> noise(parts);
  std::vector<double> signalNoise(parts);
  for (std::size_t t = 0; t < residuals.GetTiles().frames; ++t)
  {
    for (std::size_t part = 0; part < parts; ++part)
    {
      double ofPart = 0.0;
      double signalOfPart = 0.0;
      for (std::size_t i = part * length; i < (part + 1) * length; ++i)
      {
        const auto & [tile, inTile, w, z] = pixels[i];
        const float * const values = residuals.OfTile(tile) + t * residuals.GetTiles().Pixels();
        const double        weighed = w * static_cast<double>(values[inTile]);
        ofPart += weighed;
        signalOfPart += weighed * z;
      }
      noise[part] = ofPart;
      signalNoise[part] = signalOfPart;
    }
    products.noise += ProductOfParts(noise) / residuals.GetDof();
    products.signalNoise += ProductOfParts(signalNoise) / residuals.GetDof();
  }
  return products;
}
} // namespace

MeasuredNumber
EstimateLineIlluminationChange(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor)
{
  // Every n-th line is used: they cover the whole frame, and are enough.
  const SampleTiles & tiles = residuals.GetTiles();
  const auto          groups = TilesInLine(tiles, axis);
  const std::size_t   lines = groups.size() * tiles.side;
  const std::size_t step = (tiles.origins.size() + InCorrelation.tilesOfFirstLook - 1) / InCorrelation.tilesOfFirstLook;
  std::vector<LineIlluminationProducts> ofLines(lines > 0 ? (lines + step - 1) / step : 0);
  parallelFor(ofLines.size(), [&](std::size_t i) {
    const std::size_t line = i * step;
    ofLines[i] = ProductsOfLine(residuals, PixelsOfLine(residuals, groups[line / tiles.side], axis, line % tiles.side));
  });
  std::vector<LineIlluminationProducts> blocks(std::min(Blocks, ofLines.size()));
  for (std::size_t i = 0; i < ofLines.size(); ++i)
  {
    blocks[i * blocks.size() / ofLines.size()] += ofLines[i];
  }
  const JackknifeEstimate estimate = Jackknife(
    blocks, [](const LineIlluminationProducts & sum) { return Eigen::VectorXd::Constant(1, sum.OfIllumination()); });
  const MeasuredNumber square{ estimate.value(0), estimate.StandardError(0) };
  return std::isfinite(square.value) && std::isfinite(square.standardError)
           ? square
           : MeasuredNumber{ 0.0, std::numeric_limits<double>::infinity() };
}

} // namespace sensornoise
