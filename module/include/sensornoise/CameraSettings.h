// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_CameraSettings_h
#define sensornoise_CameraSettings_h

#include <cmath>
#include <limits>
#include <string>

namespace sensornoise
{

/** What a file says of the camera that took its frames. Every member is a default, which the user can overrule; what a
 * file does not say is empty, 0 or NaN, as given here. */
struct CameraSettings
{
  std::string  camera;                                                   ///< maker and model
  std::string  bayerPattern;                                             ///< "RGGB", "GRBG", "GBRG" or "BGGR"
  unsigned int bitDepth{ 0 };                                            ///< of the codes [bit]
  double       blackLevelDn{ std::numeric_limits<double>::quiet_NaN() }; ///< level without light, as the maker says
  double       whiteLevelDn{ std::numeric_limits<double>::quiet_NaN() }; ///< level at which the sensor saturates
  double       isoSpeed{ std::numeric_limits<double>::quiet_NaN() };     ///< [1]
  double       exposureSeconds{ std::numeric_limits<double>::quiet_NaN() };
  double       opticalBlackDn{ std::numeric_limits<double>::quiet_NaN() };      ///< mean of the frame's masked pixels
  double       opticalBlackErrorDn{ std::numeric_limits<double>::quiet_NaN() }; ///< its standard error, rows apart

  /** Whether a file says anything. */
  bool
  IsKnown() const
  {
    return !camera.empty() || !bayerPattern.empty() || bitDepth > 0 || std::isfinite(blackLevelDn) ||
           std::isfinite(whiteLevelDn) || std::isfinite(isoSpeed) || std::isfinite(exposureSeconds) ||
           std::isfinite(opticalBlackDn);
  }
};

} // namespace sensornoise

#endif
