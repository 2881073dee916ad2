// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ImageScale_h
#define ImageScale_h

#include "tools/NoiseModelFile.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Requires that the levels of a frame are on the scale of a report, as far as they tell. Throws std::runtime_error,
 * one sentence, where a pixel is not finite, and where the frame cannot be of the report's camera and setting:
 * - the codes of an integer frame are multiples of another number than the report's: codes times 16, for one;
 * - half of the pixels are above the highest level that the sensor attains, or below the level of no light;
 * - half of them have more than 8 times the light of the brightest that were measured.
 *
 * Returns what is odd and may be right, a sentence, or nothing: half of the pixels have more than twice the light of
 * the brightest that were measured; more than 1 % lie so far below the level of no light that the transform makes them
 * 0. \a image names the frame. */
template <typename TPixel>
std::string
RequireScale(const std::vector<TPixel> & levels, const NoiseModelFile & report, const std::string & image);

} // namespace sensornoise::tools

#endif
