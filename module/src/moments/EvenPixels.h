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

/** Returns a mask, of a frame's size, of the valid pixels near the largest signal that whole cells of \a thumbnails
 * have.
 *
 * The mean level of pixels with different signals bends more than the response at their mean signal: of a quadratic
 * response by the factor 1 + (relative variance of the signals). In textured cells this is 10 %. So the signal S is
 * lowered step by step from the brightest cells, until 4 cells hold only pixels with signals from S / 1.25 to 1.25 S.
 * Where S falls below half of the brightest signal, all valid pixels are returned.
 *
 * The signal is the level less the level at exposure 0, which follows from the mean levels of the cells at the lowest
 * and the highest exposure. \a exposures holds the exposures of all frames, \a counted the frames that count. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindEvenPixels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures,
               const StackMaps &                maps);

} // namespace sensornoise

#endif
