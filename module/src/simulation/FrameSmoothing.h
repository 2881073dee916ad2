// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameSmoothing_h
#define sensornoise_simulation_FrameSmoothing_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

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
