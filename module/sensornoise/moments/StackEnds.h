// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackEnds_h
#define sensornoise_moments_StackEnds_h

#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/OutermostLevels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

/** The value of a stack that lies farthest to one side, and of how many pixels it is the extreme over time. */
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

/** Both ends of a stack, of the pixels that are finite; the same in whatever order they are added. */
struct StackEnds
{
  StackEnd low;
  StackEnd high;

  /** Adds the pixels [begin, end) of \a moments, see TemporalMoments. */
  template <typename TMoments>
  void
  AddPixels(const TMoments & moments, std::size_t begin, std::size_t end)
  {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (moments.IsFinite(p))
      {
        low.Add(-moments.GetMinimum(p), 1);
        high.Add(moments.GetMaximum(p), 1);
      }
    }
  }

  void
  Add(const StackEnds & other)
  {
    low.Add(other.low.outwards, other.low.pixels);
    high.Add(other.high.outwards, other.high.pixels);
  }
};

/** How far the end \a level of a stack lies from the mean of the pixels that attain it, see ExtremeDepths. */
template <typename TMoments>
double
MedianDepth(const TMoments &     moments,
            OutermostLevels::End end,
            const StackEnd &     level,
            const double *       mean,
            const double *       variance)
{
  const bool          isHigh = end == OutermostLevels::End::High;
  std::vector<double> depths;
  for (std::size_t p = 0; p < moments.GetNumberOfPixels(); ++p)
  {
    if (level.outwards == (isHigh ? moments.GetMaximum(p) : -moments.GetMinimum(p)) && moments.IsFinite(p))
    {
      const double distanceDn = level.outwards - (isHigh ? mean[p] : -mean[p]);
      depths.push_back(variance[p] > 0.0 ? distanceDn / std::sqrt(variance[p]) : 0.0);
    }
  }
  return Quantile(depths, 0.5);
}

/** The levels next to an end of a stack. */
template <typename TMoments>
OutermostLevels
LevelsAt(OutermostLevels::End end, const TMoments & moments)
{
  OutermostLevels levels(end);
  const auto      add = [&](std::size_t p) {
    if (moments.IsFinite(p))
    {
      levels.Add(end == OutermostLevels::End::High ? moments.GetMaximum(p) : moments.GetMinimum(p));
    }
  };
  // Some pixels of everywhere first: then most of the others are seen at once to lie inside of the levels kept.
  const std::size_t pixels = moments.GetNumberOfPixels();
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
