// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedResults.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Jackknife.h"
#include "base/Quantiles.h"
#include "base/RegressionSums.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "pixels/GainByParts.h"
#include "refined/Constants.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t TileSide = 16; ///< [pixels]; glow and vignetting hardly change within a tile
constexpr std::size_t MostBlocks = 32;
constexpr std::size_t FewestBlocks = 4;
constexpr double      FewestPixels = 16.0; ///< in a tile

/** Sums over tiles of the centred signal x, bright minus dark mean, and of the centred dark mean y. */
struct SignalSums
{
  double square{ 0.0 };  ///< sum of x^2 without noise [DN^2]
  double product{ 0.0 }; ///< sum of x y without noise [DN^2]

  SignalSums &
  operator+=(const SignalSums & other)
  {
    square += other.square;
    product += other.product;
    return *this;
  }
  /** Returns the fraction b of the signal in the dark frames [1], from the regression of y on x, b / (1 - b). */
  double
  Fraction() const
  {
    return square + product != 0.0 ? product / (square + product) : 0.0;
  }
};

/** Returns the sums of the tile at \a left, \a top; empty sums where the contrast of the scene is below
 * InPattern.largestGain. */
SignalSums
SumTile(const DarkMaps &                  dark,
        const ReferenceFrame &            bright,
        const std::vector<std::uint8_t> & pixelUse,
        std::size_t                       left,
        std::size_t                       top)
{
  const auto frames = static_cast<double>(bright.frames);
  const auto darkFrames = static_cast<double>(dark.frames);
  double     pixels = 0.0, x = 0.0, y = 0.0, noise = 0.0, shared = 0.0;
  SignalSums sums;
  for (std::size_t row = top; row < std::min(top + TileSide, bright.geometry.height); ++row)
  {
    for (std::size_t column = left; column < std::min(left + TileSide, bright.geometry.width); ++column)
    {
      const std::size_t p = row * bright.geometry.width + column;
      if (dark.usable[p] == 0 || pixelUse[p] != static_cast<std::uint8_t>(PixelUse::Used))
      {
        continue;
      }
      const double signal = bright.mean[p] - dark.offsetDn[p];
      pixels += 1.0;
      x += signal;
      y += dark.offsetDn[p];
      sums.square += signal * signal;
      sums.product += signal * dark.offsetDn[p];
      shared += dark.varianceDn2[p] / darkFrames;
      noise += bright.variance[p] / frames;
    }
  }
  if (pixels < FewestPixels)
  {
    return {};
  }
  const double fewer = 1.0 - 1.0 / pixels;
  sums.square -= x * x / pixels + fewer * (noise + shared);
  sums.product -= x * y / pixels - fewer * shared;
  const double contrast = InPattern.largestGain * x / pixels;
  return sums.square > contrast * contrast * pixels ? sums : SignalSums();
}
} // namespace

std::optional<MeasuredNumber>
FindDarkSignal(const std::optional<KnownOffset> & offset,
               const ReferenceFrame &             bright,
               const std::vector<std::uint8_t> &  pixelUse,
               const ParallelFor &                parallelFor)
{
  if (!offset || !offset->maps || offset->maps->usable.size() != pixelUse.size())
  {
    return std::nullopt;
  }
  const std::size_t       rows = (bright.geometry.height + TileSide - 1) / TileSide;
  std::vector<SignalSums> blocks(std::min(rows, MostBlocks));
  const std::size_t       count = blocks.size();
  parallelFor(count, [&](std::size_t block) {
    for (std::size_t row = block * rows / count; row < (block + 1) * rows / count; ++row)
    {
      for (std::size_t left = 0; left < bright.geometry.width; left += TileSide)
      {
        blocks[block] += SumTile(*offset->maps, bright, pixelUse, left, row * TileSide);
      }
    }
  });
  const auto isEmpty = [](const SignalSums & sum) { return !(sum.square > 0.0); };
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), isEmpty), blocks.end());
  if (blocks.size() < FewestBlocks)
  {
    return std::nullopt;
  }
  const JackknifeEstimate estimate =
    Jackknife(blocks, [](const SignalSums & sums) { return Eigen::VectorXd::Constant(1, sums.Fraction()); });
  const MeasuredNumber fraction{ estimate.value(0), estimate.StandardError(0) };
  const bool           counts =
    fraction.value > InRefined.leastSignalOfDark && fraction.value > Significance.severalTests * fraction.standardError;
  return counts ? std::optional<MeasuredNumber>(fraction) : std::nullopt;
}

namespace
{
/** Mean offset [DN] and mean variance [DN^2] of the usable pixels of a tile of the dark frames. */
struct DarkTile
{
  double pixels;
  double offsetDn;
  double varianceDn2;
};

/** Returns the tiles of a row of tiles that have FewestPixels usable pixels. */
std::vector<DarkTile>
TilesOfRow(const DarkMaps & dark, const FrameGeometry & geometry, std::size_t row)
{
  std::vector<DarkTile> tiles;
  for (std::size_t left = 0; left < geometry.width; left += TileSide)
  {
    DarkTile tile{ 0.0, 0.0, 0.0 };
    for (std::size_t y = row * TileSide; y < std::min((row + 1) * TileSide, geometry.height); ++y)
    {
      for (std::size_t x = left; x < std::min(left + TileSide, geometry.width); ++x)
      {
        const std::size_t p = y * geometry.width + x;
        if (dark.usable[p] != 0)
        {
          tile.pixels += 1.0;
          tile.offsetDn += dark.offsetDn[p];
          tile.varianceDn2 += dark.varianceDn2[p];
        }
      }
    }
    if (tile.pixels >= FewestPixels)
    {
      tiles.push_back({ tile.pixels, tile.offsetDn / tile.pixels, tile.varianceDn2 / tile.pixels });
    }
  }
  return tiles;
}

/** Removes the blocks without tiles or pixels. Returns whether enough are left for a jackknife. */
bool
KeepFilled(std::vector<RegressionSums> & blocks)
{
  const auto isEmpty = [](const RegressionSums & sums) { return !(sums.w > 0.0); };
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), isEmpty), blocks.end());
  return blocks.size() >= FewestBlocks;
}

/** Returns whether there are maps of dark frames of this size, and their variance. */
bool
HasDarkMaps(const std::optional<KnownOffset> & offset, const FrameGeometry & geometry)
{
  return offset && offset->maps && offset->variance && offset->maps->usable.size() == geometry.Pixels();
}

/** Returns the slope of the variance over the level [DN], with its error from a jackknife. */
MeasuredNumber
SlopeOf(const std::vector<RegressionSums> & blocks)
{
  const JackknifeEstimate slope =
    Jackknife(blocks, [](const RegressionSums & sums) { return Eigen::VectorXd::Constant(1, sums.Slope()); });
  return { slope.value(0), slope.StandardError(0) };
}
} // namespace

std::optional<DarkCharge>
FindDarkCharge(const std::optional<KnownOffset> & offset,
               const FrameGeometry &              geometry,
               const ParallelFor &                parallelFor)
{
  if (!HasDarkMaps(offset, geometry))
  {
    return std::nullopt;
  }
  const DarkMaps &                   dark = *offset->maps;
  std::vector<std::vector<DarkTile>> rows((geometry.height + TileSide - 1) / TileSide);
  parallelFor(rows.size(), [&](std::size_t row) { rows[row] = TilesOfRow(dark, geometry, row); });
  std::vector<RegressionSums> blocks(std::min(rows.size(), MostBlocks));
  std::vector<double>         levels;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    for (const DarkTile & tile : rows[row])
    {
      const double x = tile.offsetDn - offset->valueDn;
      const double y = tile.varianceDn2 - offset->variance->valueDn2;
      const double w = tile.pixels;
      blocks[row * blocks.size() / rows.size()] += RegressionSums::Of(w, x, y);
      levels.push_back(tile.offsetDn);
    }
  }
  if (!KeepFilled(blocks))
  {
    return std::nullopt;
  }
  const double noiseDn = std::sqrt(offset->variance->valueDn2 / static_cast<double>(dark.frames)) / TileSide;
  const double spreadDn = offset->valueDn - Quantile(levels, InRefined.darkestTiles) - Significance.hint * noiseDn;
  return DarkCharge{ SlopeOf(blocks), std::max(0.0, spreadDn) };
}

namespace
{
/** Difference of two pixels of the dark frames. */
struct DarkDifference
{
  double offsetDn;
  double varianceDn2;
};

/** Returns the difference of pixel \a p from the pixel LargestPeriod rows below. Both have the same column and the same
 * phase of a pattern, so that offset and read noise of their amplifier cancel. Returns null if one is not usable. */
std::optional<DarkDifference>
DifferenceAt(const DarkMaps & dark, const FrameGeometry & geometry, std::size_t p)
{
  const std::size_t other = p + LargestPeriod * geometry.width;
  if (other >= dark.usable.size() || dark.usable[p] == 0 || dark.usable[other] == 0)
  {
    return std::nullopt;
  }
  return DarkDifference{ dark.offsetDn[other] - dark.offsetDn[p], dark.varianceDn2[other] - dark.varianceDn2[p] };
}

/** Returns the standard deviations of the differences of usable pixels, from their median sizes. Returns null if there
 * are fewer than FewestPixels. */
std::optional<DarkDifference>
DispersionOf(const DarkMaps & dark, const FrameGeometry & geometry)
{
  std::vector<double> offsets;
  std::vector<double> variances;
  for (const std::size_t p : SamplePixels(dark.usable))
  {
    if (const auto difference = DifferenceAt(dark, geometry, p))
    {
      offsets.push_back(std::abs(difference->offsetDn));
      variances.push_back(std::abs(difference->varianceDn2));
    }
  }
  if (static_cast<double>(offsets.size()) < FewestPixels)
  {
    return std::nullopt;
  }
  return DarkDifference{ Quantile(offsets, 0.5) / MedianOfNormal, Quantile(variances, 0.5) / MedianOfNormal };
}

/** Sums over differences of pixels. */
struct DifferenceSums
{
  RegressionSums core;          ///< differences within Significance.oneTest standard deviations
  double         pixels{ 0.0 }; ///< number of differences within Significance.everyPixel standard deviations
  double         sizeDn{ 0.0 }; ///< sum of the sizes of these differences of the offset [DN]

  void
  Add(const DarkDifference & difference, const DarkDifference & dispersion)
  {
    const double x = difference.offsetDn;
    if (std::abs(x) <= Significance.everyPixel * dispersion.offsetDn)
    {
      pixels += 1.0;
      sizeDn += std::abs(x);
    }
    if (std::abs(x) <= Significance.oneTest * dispersion.offsetDn)
    {
      const double largest = Significance.oneTest * dispersion.varianceDn2;
      const double y = std::clamp(difference.varianceDn2, -largest, largest);
      core += RegressionSums::Of(1.0, x, y);
    }
  }
};
} // namespace

std::optional<DarkCharge>
FindPixelCharge(const std::optional<KnownOffset> & offset,
                const FrameGeometry &              geometry,
                const ParallelFor &                parallelFor)
{
  if (!HasDarkMaps(offset, geometry))
  {
    return std::nullopt;
  }
  const DarkMaps & dark = *offset->maps;
  const auto       dispersion = DispersionOf(dark, geometry);
  if (!dispersion || offset->variance->valueDn2 < InCommon.hiddenVariance * dark.stepDn * dark.stepDn)
  {
    return std::nullopt;
  }
  std::vector<DifferenceSums> ofRows(std::min(geometry.height, MostBlocks));
  const std::size_t           count = ofRows.size();
  parallelFor(count, [&](std::size_t block) {
    const std::size_t end = (block + 1) * geometry.height / count * geometry.width;
    for (std::size_t p = block * geometry.height / count * geometry.width; p < end; ++p)
    {
      if (const auto difference = DifferenceAt(dark, geometry, p))
      {
        ofRows[block].Add(*difference, *dispersion);
      }
    }
  });
  std::vector<RegressionSums> blocks;
  double                      pixels = 0.0;
  double                      sizeDn = 0.0;
  for (const DifferenceSums & sums : ofRows)
  {
    blocks.push_back(sums.core);
    pixels += sums.pixels;
    sizeDn += sums.sizeDn;
  }
  return KeepFilled(blocks) ? std::optional<DarkCharge>({ SlopeOf(blocks), sizeDn / pixels }) : std::nullopt;
}

double
DarkCharge::VarianceDn2(double gain) const
{
  const bool isOtherCause = slope.value - Significance.hint * slope.standardError > InRefined.mostSlopeOfCharge * gain;
  const double beyond = SizeBeyondChance(slope.value, slope.standardError * slope.standardError, Significance.hint);
  return slope.value > 0.0 && !isOtherCause ? beyond * spreadDn : 0.0;
}

double
DarkCharges::VarianceDn2(double gain) const
{
  return (ofPlaces ? ofPlaces->VarianceDn2(gain) : 0.0) + (ofPixels ? ofPixels->VarianceDn2(gain) : 0.0);
}

} // namespace sensornoise
