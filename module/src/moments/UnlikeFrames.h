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

/** Finds the frames that are unlike the others, in their order; none if fewer than MinimumFrames would be left, or if
 * more than a fifth of the frames that have something in them are unlike.
 *
 * A frame of the burst is a level plus a factor times the mean frame, but for noise, vibration, and light that is not
 * the same everywhere, of which the others have as much. A dark frame has the factor 0: it belongs to the burst.
 * Estimator.md, 3.1. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
FindUnlikeFrames(const FrameThumbnails & thumbnails);

/** Joins the unlike frames of several parts of \a frames, as the planes of a mosaic; none if those that have something
 * in them are more than \a largestShare. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
JoinUnlikeFrames(const std::vector<std::vector<LeftOutFrame>> & ofParts,
                 std::size_t                                    frames,
                 double                                         largestShare = InMoments.largestLeftOutShare);

/** The numbers of the frames. */
SensorNoise_EXPORT std::vector<std::size_t>
NumbersOf(const std::vector<LeftOutFrame> & frames);

} // namespace sensornoise

#endif
