// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CommonNoise_h
#define sensornoise_correlation_CommonNoise_h

#include "SensorNoiseExport.h"
#include "correlation/LagSums.h"
#include "correlation/SharedLight.h"

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
