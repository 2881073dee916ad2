// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "pixels/GainByParts.h"
#include "pixels/ProjectedVariance.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

PartTiles
TilesOfMeasured(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  VarianceData data = projected.GetData(mask);
  data.variance.ratios = nullptr;
  return MakePartTiles(data, projected.GetFrame().geometry, reference, parallelFor);
}

namespace
{
/** The excess of tiles: median, scatter beyond chance, and mean over the mean fraction of shot noise [1]. */
struct ExcessOfTiles
{
  double median{ 0.0 };
  double spread{ 0.0 };
  double ofShot{ 0.0 };
};

/** Returns the excess of \a tiles. Null: there are too few of them. */
std::optional<ExcessOfTiles>
SummariseExcess(const std::vector<TileExcess> & tiles)
{
  std::vector<double> excess;
  std::vector<double> errors;
  double              sum = 0.0;
  double              shot = 0.0;
  for (const TileExcess & tile : tiles)
  {
    excess.push_back(tile.excess);
    errors.push_back(tile.error);
    sum += tile.pixels * tile.excess;
    shot += tile.pixels * tile.shotFraction;
  }
  if (excess.size() < InParts.fewestTiles || !(shot > 0.0))
  {
    return std::nullopt;
  }
  const double        median = QuantileOf(excess, 0.5);
  std::vector<double> distances;
  std::transform(excess.begin(), excess.end(), std::back_inserter(distances), [median](double own) {
    return std::abs(own - median);
  });
  const double scatter = QuantileOf(std::move(distances), 0.5) / MedianOfNormal;
  const double chance = QuantileOf(std::move(errors), 0.5);
  return ExcessOfTiles{ median, std::sqrt(std::max(0.0, scatter * scatter - chance * chance)), sum / shot };
}

/** Returns the pixels that are left out as not static, and have no used pixel beyond a neighbourhood, at eight places
 * around them: neighbourhoods at the edge of a region reach into it and out of it. */
std::vector<std::uint8_t>
InnerPixels(const std::vector<std::uint8_t> & pixelUse, const FrameGeometry & geometry, const ParallelFor & parallelFor)
{
  const std::size_t reach = InPixels.neighbourhoodRadius + 1;
  const auto        around = [reach](std::size_t at, std::size_t size) {
    return std::array<std::size_t, 3>{ at - std::min(at, reach), at, std::min(size - 1, at + reach) };
  };
  std::vector<std::uint8_t> inner(pixelUse.size());
  ForPixels(inner.size(), parallelFor, [&](std::size_t p) {
    bool isInner = pixelUse[p] == static_cast<std::uint8_t>(PixelUse::NotStatic);
    for (const std::size_t y : around(p / geometry.width, geometry.height))
    {
      for (const std::size_t x : around(p % geometry.width, geometry.width))
      {
        isInner = isInner && pixelUse[y * geometry.width + x] != static_cast<std::uint8_t>(PixelUse::Used);
      }
    }
    inner[p] = isInner ? 1 : 0;
  });
  return inner;
}
} // namespace

double
ExcessOfLeftOut(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & pixelUse,
                const ParallelFor &               parallelFor)
{
  const auto numberOf = [&](PixelUse use) {
    return static_cast<double>(std::count(pixelUse.begin(), pixelUse.end(), static_cast<std::uint8_t>(use)));
  };
  const double leftOut = numberOf(PixelUse::NotStatic);
  if (leftOut < InParts.leastLeftOut * (numberOf(PixelUse::Used) + leftOut))
  {
    return 0.0;
  }
  const std::vector<std::uint8_t> inner = InnerPixels(pixelUse, projected.GetFrame().geometry, parallelFor);
  const std::uint8_t * const      classOf = projected.GetSquares().GetClasses().data();
  std::vector<double>             classes;
  for (std::size_t p = 0; p < inner.size(); ++p)
  {
    if (inner[p] != 0)
    {
      classes.push_back(classOf[p]);
    }
  }
  if (classes.empty())
  {
    return 0.0;
  }
  const auto excessBetween = [&](double low, double high) {
    std::vector<std::uint8_t> part(inner.size());
    ForPixels(part.size(), parallelFor, [&](std::size_t p) {
      part[p] = classOf[p] > low && classOf[p] <= high ? inner[p] : std::uint8_t{ 0 };
    });
    return SummariseExcess(TilesOfMeasured(projected, reference, part, parallelFor).places);
  };
  const double middle = Quantile(classes, 0.5);
  const double upper = Quantile(classes, 0.75);
  const double highest = Quantile(classes, 1.0);
  const auto   rough = excessBetween(middle, highest);
  if (!(rough && rough->spread < InParts.largestSpread * rough->median))
  {
    return 0.0;
  }
  // Motion adds the more variance, the rougher the scene is. The smoother half may lie between edges that are processed
  // in another way, so the quarters of the rougher half are compared, if they have tiles enough.
  const auto roughest = excessBetween(upper, highest);
  const auto third = excessBetween(middle, upper);
  const bool areQuarters = roughest && third;
  const auto smoother = areQuarters ? third : excessBetween(-1.0, middle);
  const auto rougher = areQuarters ? roughest : rough;
  return smoother && smoother->median > (1.0 - InParts.largestSpread) * rougher->median ? rough->ofShot : 0.0;
}

} // namespace sensornoise
