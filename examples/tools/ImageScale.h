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

/** Tests whether the grey values of a frame can be on the scale of a report. Throws std::runtime_error, with a
 * message of one sentence, if a pixel is not finite, or in any of these cases:
 * - The quantization step of an integer frame is at least 4 times, or at most half of, the step of the report. This
 *   is tested for a step of at least 1 DN in the report and at least 16 distinct grey values. An example is a frame
 *   multiplied by 16.
 * - The median pixel is above the highest level that the sensor attains, or so far below the level of zero variance
 *   that the transform gives 0.
 * - The signal of the median pixel is more than 8 times the largest mean signal in the report.
 *
 * Returns a warning of one sentence, or an empty text. It warns if the signal of the median pixel is more than 2
 * times the largest mean signal, or if the transform gives 0 for more than 1 % of the pixels. \a image names the
 * frame in messages. */
template <typename TPixel>
std::string
RequireScale(const std::vector<TPixel> & levels, const NoiseModelFile & report, const std::string & image);

} // namespace sensornoise::tools

#endif
