// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_CameraSettings_h
#define sensornoise_CameraSettings_h

#include <cmath>
#include <limits>
#include <string>

namespace sensornoise
{

/** Settings of the camera, as the file of the frames records them. Each member is a default that the user can overrule.
 * A setting that the file does not record is empty, 0 or NaN, as in the initial value of its member. */
struct CameraSettings
{
  std::string  camera;        ///< maker and model; "": not recorded
  std::string  bayerPattern;  ///< "RGGB", "GRBG", "GBRG" or "BGGR"; "": not recorded
  unsigned int bitDepth{ 0 }; ///< bit depth of the digital numbers [bit]; 0: not recorded
  /** Dark offset (black level) by the maker of the camera [DN]. */
  double blackLevelDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Level at which the sensor saturates, by the maker of the camera [DN]. */
  double whiteLevelDn{ std::numeric_limits<double>::quiet_NaN() };
  double isoSpeed{ std::numeric_limits<double>::quiet_NaN() };        ///< ISO speed [1]
  double exposureSeconds{ std::numeric_limits<double>::quiet_NaN() }; ///< exposure time [s]
  /** Mean of the masked (optical-black) pixels of the frame [DN]; NaN also if they lie in fewer than 8 rows. */
  double opticalBlackDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Standard error of opticalBlackDn, from the scatter of the means of rows [DN]. It contains the noise of rows. */
  double opticalBlackErrorDn{ std::numeric_limits<double>::quiet_NaN() };

  /** Returns whether the file records any setting. */
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
