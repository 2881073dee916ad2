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
#ifndef sensornoise_correlation_CommonNoise_h
#define sensornoise_correlation_CommonNoise_h

#include "SensorNoiseExport.h"
#include "sensornoise/correlation/LagSums.h"
#include "sensornoise/correlation/SharedLight.h"

#include <array>

namespace sensornoise
{

/** What pixels share however far apart they are: it is taken off what neighbours share. */
struct CommonNoise
{
  double                                 light{ 0.0 }; ///< times the square of the light: light that is left [1]
  std::array<double, SharedLight::Lines> rows{};       ///< of pixels as many rows apart, far along them [DN^2]
  std::array<double, SharedLight::Lines> columns{};    ///< of pixels as many columns apart [DN^2]

  /** Takes it off the sums of a lag in space. */
  SensorNoise_EXPORT LagSums
  TakeOff(LagSums sums, const Lag & lag) const;
};

/** Of the sums of tiles. */
SensorNoise_EXPORT CommonNoise
FindCommonNoise(const SharedLight & sums);

} // namespace sensornoise

#endif
