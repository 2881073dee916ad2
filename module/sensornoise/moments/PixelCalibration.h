/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_moments_PixelCalibration_h
#define sensornoise_moments_PixelCalibration_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/moments/DarkMaps.h"
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
