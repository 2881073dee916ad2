// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_LevelPattern_h
#define sensornoise_pixels_LevelPattern_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

struct ReferenceFrame;
struct VarianceData;
struct VarianceLine;

/** How much of what the levels differ by could be the pixels' own: their gains, their offsets.
 *
 * Where levels differ because of the light, the variance rises by the gain; because of the pixels' gains, by twice the
 * gain; because of their offsets, not at all. So a share s of the levels' variance moves the slope by between -s and +s
 * of the gain. Patterns are looked for where the scene is flattest: elsewhere, what differs from pixel to pixel is
 * light. What differs between the halves of a sensor, or repeats over wide distances, cannot be told from light. */
struct LevelPattern
{
  double lightDn2{ 0.0 };    ///< weighted variance of the levels, without the noise of their means [DN^2]
  double gainShare{ 0.0 };   ///< of lightDn2 that a pattern of gain or efficiency could make, its error included [1]
  double offsetShare{ 0.0 }; ///< the same of a pattern of offset [1]

  /** Of the pixels' offsets, at most [DN^2]. */
  double
  OffsetVarianceDn2() const
  {
    return lightDn2 > 0.0 ? offsetShare * lightDn2 : 0.0;
  }
  /** By how much the slope could be off, relative to the gain [1]. */
  double
  LargestShare() const
  {
    return gainShare > offsetShare ? gainShare : offsetShare;
  }
};

/** How far DiagonalMean() looks [pixels]. */
inline constexpr std::size_t DiagonalReach = 2;

/** The mean of the eight pixels that are one and two steps away on the diagonals: light without the pixel's own
 * pattern, or that of its row or column [DN]. \a p is two pixels from the border or more. */
inline double
DiagonalMean(const double * mean, std::size_t width, std::size_t p)
{
  const double * at = mean + p;
  const auto     w = static_cast<std::ptrdiff_t>(width);
  return 0.125 * (at[-w - 1] + at[-w + 1] + at[w - 1] + at[w + 1] + at[-2 * w - 2] + at[-2 * w + 2] + at[2 * w - 2] +
                  at[2 * w + 2]);
}

/** Whether DiagonalMean() is made of valid pixels alone: one step away a usable pixel vouches for its neighbours. */
inline bool
HasDiagonals(const std::uint8_t * usable, std::size_t width, std::size_t p)
{
  const std::uint8_t * at = usable + p;
  const auto           w = static_cast<std::ptrdiff_t>(width);
  return std::min(std::min(at[-w - 1], at[-w + 1]), std::min(at[w - 1], at[w + 1])) != 0; // without branches
}

/** Measures the pattern of the pixels that are used, whose variance is \a data and follows \a line. Shares are relative
 * to \a blackDn, the level without light, or a level that it is not below. */
SensorNoise_EXPORT LevelPattern
MeasureLevelPattern(const ReferenceFrame & frame,
                    const VarianceData &   data,
                    const VarianceLine &   line,
                    double                 blackDn,
                    const ParallelFor &    parallelFor);

} // namespace sensornoise

#endif
