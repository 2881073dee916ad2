// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_EvenPixels_h
#define sensornoise_moments_EvenPixels_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class FrameThumbnails;
struct StackMaps;

/** Returns a mask of the frame: the valid pixels near the largest signal at which whole cells of \a thumbnails are
 * uniform.
 *
 * The mean level of pixels with different signals has a larger curvature than the response at their mean signal. For a
 * quadratic response the factor is 1 + (relative variance of the signals). In textured cells this is 10 %. The signal
 * S is therefore lowered step by step from the brightest cells, until 4 cells hold only pixels with signals from S /
 * 1.25 to 1.25 S. Where S falls below half of the brightest signal, all valid pixels are returned.
 *
 * The signal is the level minus the level at exposure 0, which follows from the mean levels of the cells at the lowest
 * and the highest exposure.
 * \param exposures exposures of all frames
 * \param counted numbers of the frames that are counted */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindEvenPixels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures,
               const StackMaps &                maps);

} // namespace sensornoise

#endif
