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
#ifndef sensornoise_simulation_FrameSmoothing_h
#define sensornoise_simulation_FrameSmoothing_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/simulation/DoubleFrame.h"

namespace sensornoise
{

/** Smoothing in the camera: a Gaussian filter of the codes, the kernel of GaussianBlur(). White noise keeps (sum of
 * k^2)^2 of its variance, k the kernel of one axis: 0.25 at 0.6 pixels. */
struct SmoothingSettings
{
  /** Standard deviation of the kernel [pixel], 0 to 100; 0: none. */
  double sdPixels{ 0.0 };

  bool
  IsOn() const
  {
    return sdPixels > 0.0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const SmoothingSettings & settings);

/** \a codesDn smoothed [DN]. */
SensorNoise_EXPORT DoubleFrame
SmoothFrame(DoubleFrame codesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
