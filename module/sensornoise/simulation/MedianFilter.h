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
#ifndef sensornoise_simulation_MedianFilter_h
#define sensornoise_simulation_MedianFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/simulation/DoubleFrame.h"

namespace sensornoise
{

/** Median filter in the camera, frame by frame: a pixel becomes the median of the square around it, edge pixels
 * replicated. Not linear: edges stay, noise loses more than the mean of as many pixels would leave. */
struct MedianSettings
{
  /** The square is 2 radius + 1 pixels wide [pixel], 0 to 10; 1: 3 x 3; 0: none. */
  unsigned int radiusPixels{ 0 };

  bool
  IsOn() const
  {
    return radiusPixels > 0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const MedianSettings & settings);

/** \a codesDn filtered [DN]. */
SensorNoise_EXPORT DoubleFrame
FilterByMedian(const DoubleFrame & codesDn, const MedianSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
