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

/** A quantity of every pixel of the frame and the ends of its 95 % interval; NaN: not known. */
struct IntervalMapDn
{
  std::vector<double> value; ///< [DN]
  std::vector<double> low;   ///< [DN]
  std::vector<double> high;  ///< [DN]
};

/** Offset and read noise of each pixel by itself: what single-molecule microscopy calls the camera calibration. */
struct PixelCalibration
{
  IntervalMapDn offset;
  IntervalMapDn readNoise; ///< without the noise of rounding to codes
};

/** The pixels' own offset and read noise from dark frames.
 *
 * For a pixel with Gaussian noise each interval holds the truth with a probability of 95 %: of the offset by Student's
 * distribution, of the read noise by chi-square's (mean plus and minus 1.96 errors would cover 90 % of the offsets of 8
 * frames). What rounding to codes hides of the offset of a pixel with hardly any noise widens the interval by up to
 * half a step; read noise that rounding may hide has an interval from 0 to half a step or more. The common drift of the
 * frames is in none of them. Defective pixels have values as any other; those that are not finite, clipped or masked
 * have none. */
SensorNoise_EXPORT PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
