// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedSettings_h
#define sensornoise_published_PublishedSettings_h

#include "SensorNoiseExport.h"
#include "base/RollingShutter.h"
#include "moments/CodeSettings.h"

namespace sensornoise
{

/** Every parameter of the published method, with the paper's values (Sur & Gredi\'ac 2015). */
struct SensorNoise_EXPORT PublishedSettings
{
  /** Level of the test that finds pixels moved by vibrations (section 3.1), a probability. Larger: fewer pixels kept.
   */
  double level{ 0.01 };
  /** Quantiles of the mean at which S^* and S_* lie (section 3.2), 0 to 1. */
  double brightQuantile{ 0.99 };
  double darkQuantile{ 0.01 };
  /** Whether the flicker may differ from row to row (section 3.5). Auto finds out. */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** sigma_y of (3.28) for RollingShutter::Fixed [rows]. */
  double sigmaRows{ 50.0 };
  /** Axis along which the shutter travels: 1 = y; 0 = x, the rows are then columns of the frame. */
  unsigned int shutterAxis{ 1 };
  /** Excess noise factor F of the sensor, 1 or more [1]: the gain is the slope of the variance divided by F. See
   * DivideExcessNoise(). */
  double excessNoiseFactor{ 1.0 };
  /** What is known of the codes; the rest is found. */
  CodeSettings codes;

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;
};

} // namespace sensornoise

#endif
