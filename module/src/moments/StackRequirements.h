// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackRequirements_h
#define sensornoise_moments_StackRequirements_h

#include "SensorNoiseExport.h"

#include "base/NothingToMeasure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

struct FrameGeometry;

/** Least number of frames of a stack that the methods measure. */
inline constexpr std::size_t MinimumFrames = 5;

/** Largest number of frames: up to it all sums over integer pixels are exact. The moments are exact for up to 2^22
 * frames, see IntegerMoments::MostFrames, the projections of the refined method for 2^34. The illumination factors of
 * the published method are rounded so that their sums are exact. At 2^22 frames they keep 15 bits: the rounding, at
 * most 3e-5 of the flicker, is far below any noise. */
inline constexpr std::size_t MaximumFrames = std::size_t{ 1 } << 22;

/** Throws std::invalid_argument if a stack has fewer than MinimumFrames or more than MaximumFrames frames, frames of
 * fewer than 3 x 3 pixels, or a mask of another size than a frame. \a maskPixels is 0 without a mask. */
SensorNoise_EXPORT void
RequireStack(const FrameGeometry & geometry, std::size_t frames, std::size_t maskPixels);

/** Throws NothingToMeasure if fewer than MinimumFrames distinct frames are left. It does not if no pixel is \a valid:
 * then this is the reason why frames are equal, and it is reported instead. */
inline void
RequireDistinctFrames(std::size_t distinct, const std::vector<std::uint8_t> & valid)
{
  if (distinct < MinimumFrames && std::find(valid.begin(), valid.end(), std::uint8_t{ 1 }) != valid.end())
  {
    throw NothingToMeasure("only " + std::to_string(distinct) +
                           (distinct == 1 ? " distinct frame is" : " distinct frames are") +
                           " left, as equal frames are counted once; expected at least " +
                           std::to_string(MinimumFrames) + ". Record more frames");
  }
}

} // namespace sensornoise

#endif
