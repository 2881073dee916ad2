// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackEnds_h
#define sensornoise_moments_StackEnds_h

#include "base/Quantiles.h"
#include "moments/Codes.h"
#include "moments/OutermostLevels.h"
#include "moments/TemporalMaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

/** The highest or the lowest value of a stack, and the number of pixels whose extreme over time it is. */
struct StackEnd
{
  double      outwards{ -std::numeric_limits<double>::infinity() }; ///< the highest value, or minus the lowest [DN]
  std::size_t pixels{ 0 };

  void
  Add(double otherOutwards, std::size_t otherPixels)
  {
    if (otherOutwards >= outwards)
    {
      pixels = otherPixels + (otherOutwards == outwards ? pixels : 0);
      outwards = otherOutwards;
    }
  }
};

/** Both ends of a stack, over the pixels that are finite; the order of adding has no effect. */
struct StackEnds
{
  StackEnd low;
  StackEnd high;
  bool     areWhole{ true }; ///< all extremes are whole numbers that CodeHistogram has room for

  /** Adds the pixels [begin, end). */
  template <typename TPixel>
  void
  AddPixels(const TemporalMaps<TPixel> & maps, std::size_t begin, std::size_t end)
  {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (maps.IsFinite(p))
      {
        low.Add(-maps.GetMinimum(p), 1);
        high.Add(maps.GetMaximum(p), 1);
        areWhole = areWhole && CodeHistogram::IsCode(maps.GetMinimum(p)) && CodeHistogram::IsCode(maps.GetMaximum(p));
      }
    }
  }

  void
  Add(const StackEnds & other)
  {
    low.Add(other.low.outwards, other.low.pixels);
    high.Add(other.high.outwards, other.high.pixels);
    areWhole = areWhole && other.areWhole;
  }
};

/** Returns the distance of the end \a level of a stack from the mean of the pixels that attain it, see ExtremeDepths.
 */
template <typename TPixel>
double
MedianDepth(const TemporalMaps<TPixel> & maps, OutermostLevels::End end, const StackEnd & level)
{
  const bool          isHigh = end == OutermostLevels::End::High;
  std::vector<double> depths;
  for (std::size_t p = 0; p < maps.GetNumberOfPixels(); ++p)
  {
    if (level.outwards == (isHigh ? maps.GetMaximum(p) : -maps.GetMinimum(p)) && maps.IsFinite(p))
    {
      const double distanceDn = level.outwards - (isHigh ? maps.mean[p] : -maps.mean[p]);
      depths.push_back(maps.variance[p] > 0.0 ? distanceDn / std::sqrt(maps.variance[p]) : 0.0);
    }
  }
  return Quantile(depths, 0.5);
}

/** Returns the levels next to an end of a stack. */
template <typename TPixel>
OutermostLevels
LevelsAt(OutermostLevels::End end, const TemporalMaps<TPixel> & maps)
{
  OutermostLevels levels(end);
  const auto      add = [&](std::size_t p) {
    if (maps.IsFinite(p))
    {
      levels.Add(end == OutermostLevels::End::High ? maps.GetMaximum(p) : maps.GetMinimum(p));
    }
  };
  // Pixels from the whole frame come first: most of the others are then rejected at once, because they lie inside of
  // the levels kept.
  const std::size_t pixels = maps.GetNumberOfPixels();
  const std::size_t stride = std::max<std::size_t>(1, pixels / 8192);
  for (std::size_t first = 0; first < pixels; first += stride)
  {
    add(first);
  }
  for (std::size_t first = 0; first < pixels; first += stride)
  {
    for (std::size_t p = first + 1; p < std::min(first + stride, pixels); ++p)
    {
      add(p);
    }
  }
  return levels;
}

} // namespace sensornoise

#endif
