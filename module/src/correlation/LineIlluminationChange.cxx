// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LineIlluminationChange.h"

#include "correlation/Constants.h"
#include "correlation/Jackknife.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

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
  double noise{ 0.0 };      ///< products of sums of w y
  double constant{ 0.0 };   ///< products of sums of w: the constant's own normal equation
  double mixed{ 0.0 };      ///< products of sums of w z: couples both normal equations
  double lightNoise{ 0.0 }; ///< products of sums of w z y
  double square{ 0.0 };     ///< products of sums of w z^2: the coefficient's own normal equation

  LineIlluminationProducts &
  operator+=(const LineIlluminationProducts & other)
  {
    noise += other.noise;
    constant += other.constant;
    mixed += other.mixed;
    lightNoise += other.lightNoise;
    square += other.square;
    return *this;
  }

  /** Returns the coefficient of the product of the signals [1]; NaN where it is not identifiable. */
  double
  OfLight() const
  {
    const double determinant = constant * square - mixed * mixed;
    return determinant > InCorrelation.leastSpread * constant * square
             ? (constant * lightNoise - mixed * noise) / determinant
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

/** A pixel of a line, with its weight \a w = 1 / V [1/DN^2] and signal \a z [DN]. */
struct PixelOfLine
{
  std::size_t part;
  std::size_t tile;
  std::size_t inTile;
  double      w;
  double      z;
};

/** Returns the pixels of line \a line of \a tiles, which lie side by side, in the order of the frame. */
std::vector<PixelOfLine>
PixelsOfLine(const NoiseResiduals & residuals, const std::vector<std::size_t> & tiles, LineAxis axis, std::size_t line)
{
  const SampleTiles &      of = residuals.GetTiles();
  const std::size_t        length = of.side / PartsOfTile;
  std::vector<PixelOfLine> pixels;
  pixels.reserve(tiles.size() * of.side);
  for (std::size_t part = 0; part < PartsOfTile * tiles.size(); ++part)
  {
    const std::size_t tile = tiles[part / PartsOfTile];
    for (std::size_t k = part % PartsOfTile * length; k < (part % PartsOfTile + 1) * length; ++k)
    {
      const std::size_t p = of.InTile(axis, line, k);
      pixels.push_back({ part,
                         tile,
                         p,
                         static_cast<double>(residuals.WeightOf(tile)[p]),
                         static_cast<double>(residuals.LightOf(tile)[p]) });
    }
  }
  return pixels;
}

LineIlluminationProducts
ProductsOfLine(const NoiseResiduals & residuals, const std::vector<PixelOfLine> & pixels)
{
  const std::size_t   parts = pixels.empty() ? 0 : pixels.back().part + 1;
  std::vector<double> constant(parts, 0.0);
  std::vector<double> mixed(parts, 0.0);
  std::vector<double> square(parts, 0.0);
  for (const PixelOfLine & pixel : pixels)
  {
    constant[pixel.part] += pixel.w;
    mixed[pixel.part] += pixel.w * pixel.z;
    square[pixel.part] += pixel.w * pixel.z * pixel.z;
  }
  LineIlluminationProducts products;
  products.constant = ProductOfParts(constant);
  products.mixed = ProductOfParts(mixed);
  products.square = ProductOfParts(square);
  std::vector<double> noise(parts);
  std::vector<double> lightNoise(parts);
  for (std::size_t t = 0; t < residuals.GetTiles().frames; ++t)
  {
    std::fill(noise.begin(), noise.end(), 0.0);
    std::fill(lightNoise.begin(), lightNoise.end(), 0.0);
    for (const PixelOfLine & pixel : pixels)
    {
      const float * const values = residuals.OfTile(pixel.tile) + t * residuals.GetTiles().Pixels();
      const double        weighed = pixel.w * static_cast<double>(values[pixel.inTile]);
      noise[pixel.part] += weighed;
      lightNoise[pixel.part] += weighed * pixel.z;
    }
    products.noise += ProductOfParts(noise) / residuals.GetDof();
    products.lightNoise += ProductOfParts(lightNoise) / residuals.GetDof();
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
  const std::size_t   step =
    (tiles.origins.size() + InCorrelation.mostTilesOfLineIllumination - 1) / InCorrelation.mostTilesOfLineIllumination;
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
  const JackknifeEstimate estimate =
    Jackknife(blocks, [](const LineIlluminationProducts & sum) { return Eigen::VectorXd::Constant(1, sum.OfLight()); });
  const MeasuredNumber square{ estimate.value(0), estimate.StandardError(0) };
  return std::isfinite(square.value) && std::isfinite(square.standardError)
           ? square
           : MeasuredNumber{ 0.0, std::numeric_limits<double>::infinity() };
}

} // namespace sensornoise
