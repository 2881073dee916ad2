// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/LineIllumination.h"

#include "base/Eigen.h"
#include "sensornoise/Report.h"
#include "base/Constants.h"
#include "correlation/Jackknife.h"
#include "refined/Constants.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
/** Sums for the illumination changes of a tile, and for the variance that they add to its pixels. */
struct TileIllumination
{
  double frames{ 0.0 };
  double pixels{ 0.0 };
  double square{ 0.0 }; ///< of the tile's signal over the frames, in units of its noise

  TileIllumination &
  operator+=(const TileIllumination & other)
  {
    frames += other.frames;
    pixels += other.pixels;
    square += other.square;
    return *this;
  }
};

/** Returns the sums of tile \a i. Its signal in a frame, sum w z r, has the variance sum w z^2 by the noise of the
 * pixels. A relative change e of the illumination increases this variance by the fraction e^2 sum w z^2, and the
 * variance of the pixels by the mean of e^2 w z^2 over them. */
TileIllumination
SumTileIllumination(const NoiseResiduals & residuals, std::size_t i)
{
  const float * const w = residuals.WeightOf(i);
  const float * const z = residuals.LightOf(i);
  const std::size_t   size = residuals.GetTiles().Pixels();
  TileIllumination    light;
  double              noise = 0.0;
  for (std::size_t p = 0; p < size; ++p)
  {
    light.pixels += w[p] > 0.0F ? 1.0 : 0.0;
    noise += static_cast<double>(w[p]) * static_cast<double>(z[p]) * static_cast<double>(z[p]);
  }
  if (!(noise > 0.0))
  {
    return {};
  }
  for (std::size_t t = 0; t < residuals.GetTiles().frames; ++t)
  {
    const float * const values = residuals.OfTile(i) + t * size;
    double              sum = 0.0;
    for (std::size_t p = 0; p < size; ++p)
    {
      sum += static_cast<double>(w[p]) * static_cast<double>(z[p]) * static_cast<double>(values[p]);
    }
    light.square += sum * sum / noise;
  }
  light.frames = residuals.GetDof();
  return light;
}
} // namespace

double
EffectOfLineIllumination(const MeasuredNumber & square, double signalDn, double gain, double least)
{
  const double effect = square.value * std::max(0.0, signalDn) / gain;
  return square.value > Significance.severalTests * square.standardError && effect > least ? effect : 0.0;
}

double
RestOfIllumination(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<TileIllumination> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumTileIllumination(residuals, i); });
  const JackknifeEstimate estimate = Jackknife(tiles, [](const TileIllumination & sum) {
    return Eigen::VectorXd::Constant(1, sum.pixels > 0.0 ? (sum.square - sum.frames) / sum.pixels : 0.0);
  });
  // Both sums are over the tiles: the excess of each tile is a sum over its frames.
  const double perFrame = 1.0 / std::max(1.0, residuals.GetDof());
  const double rest = estimate.value(0) * perFrame;
  const double error = estimate.StandardError(0) * perFrame;
  return rest > Significance.severalTests * error &&
             rest > InRefined.largestLineIllumination / InRefined.slopeOfRemaining
           ? rest
           : 0.0;
}

void
SubtractLineIllumination(LineIllumination &          lines,
                         NoiseResiduals &            residuals,
                         ProjectedVariance &         projected,
                         std::vector<std::uint8_t> & chosen,
                         std::vector<std::uint8_t> & pixelUse,
                         const ParallelFor &         parallelFor)
{
  const std::vector<float>  left = residuals.TakeOffLines(lines.axis, chosen, parallelFor);
  const SampleTiles &       tiles = residuals.GetTiles();
  const std::size_t         width = projected.GetFrame().geometry.width;
  std::vector<std::uint8_t> sampled(chosen.size(), 0);
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const std::size_t pixel = tiles.PixelOf(i, p, width);
      if (chosen[pixel] != 0 && left[i * tiles.Pixels() + p] > 0.0F)
      {
        sampled[pixel] = 1;
        projected.ReplaceSquares(pixel, residuals.SquaresOf(i)[p], residuals.GetDof());
      }
    }
  }
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    if (chosen[p] != 0 && sampled[p] == 0)
    {
      pixelUse[p] = static_cast<std::uint8_t>(PixelUse::FlickerUnknown);
    }
  }
  chosen = std::move(sampled);
  lines.isTakenOff = true;
  lines.pixels = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), std::uint8_t{ 1 }));
}

} // namespace sensornoise
