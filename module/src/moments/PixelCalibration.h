// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_PixelCalibration_h
#define sensornoise_moments_PixelCalibration_h

#include "sensornoise/Parallel.h"
#include "moments/DarkMaps.h"
#include "SensorNoiseExport.h"

#include <vector>

namespace sensornoise
{

/** A quantity of every pixel of the frame and the bounds of its 95 % interval; NaN: not known. */
struct IntervalMapDn
{
  std::vector<double> value; ///< values [DN]
  std::vector<double> low;   ///< lower bounds [DN]
  std::vector<double> high;  ///< upper bounds [DN]
};

/** Offset and read noise of each pixel: the camera calibration of single-molecule microscopy. */
struct PixelCalibration
{
  IntervalMapDn offset;
  IntervalMapDn readNoise; ///< without quantization noise
};

/** Computes the offset and the read noise of each pixel from dark frames.
 *
 * For a pixel with Gaussian noise each interval contains the true value with a probability of 95 %. Student's
 * distribution is used for the offset and the chi-square distribution for the read noise. (The mean plus and minus
 * 1.96 standard errors would cover 90 % of the offsets of 8 frames.) The error of the offset by rounding widens the
 * interval of a pixel with hardly any noise by up to half a step. Read noise that rounding may hide has an interval
 * from 0 to half a step or more. The common drift of the frames is in none of the intervals. Defective pixels have
 * values, too. Pixels that are not finite, clipped or masked have none.
 *
 * Throws std::invalid_argument if there are fewer than two frames, or not as many variances as offsets. */
SensorNoise_EXPORT PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
