// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_UnlikeFrames_h
#define sensornoise_moments_UnlikeFrames_h

#include "sensornoise/Report.h"
#include "SensorNoiseExport.h"
#include "moments/Constants.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class FrameThumbnails;

/** Finds the frames that are unlike the others, in ascending order. The list is empty if fewer than MinimumFrames would
 * be left, or if more than a fifth of the frames with content are unlike.
 *
 * A frame of the burst is a level plus a factor times the mean frame, except for noise, vibration and local changes of
 * the illumination. These are as large in the other frames. A dark frame has the factor 0: it belongs to the burst.
 * Estimator.md, 3.1. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
FindUnlikeFrames(const FrameThumbnails & thumbnails);

/** Joins the unlike frames of several parts of \a frames, such as the planes of a mosaic. The list is empty if the
 * unlike frames with content are more than the fraction \a largestFraction [1], or if fewer than MinimumFrames would be
 * left. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
JoinUnlikeFrames(const std::vector<std::vector<LeftOutFrame>> & ofParts,
                 std::size_t                                    frames,
                 double                                         largestFraction = InMoments.largestLeftOutFraction);

/** Returns the numbers of the frames. */
SensorNoise_EXPORT std::vector<std::size_t>
NumbersOf(const std::vector<LeftOutFrame> & frames);

} // namespace sensornoise

#endif
