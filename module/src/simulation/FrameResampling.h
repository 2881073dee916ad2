// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameResampling_h
#define sensornoise_simulation_FrameResampling_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"
#include "simulation/Interpolation.h"

namespace sensornoise
{

/** Resampling in the camera, as digital stabilisation or lens correction does: the frame at (x + shiftX, y + shiftY),
 * interpolated, edge pixels replicated. A fraction f of a pixel leaves (1 - f)^2 + f^2 of the variance along its axis
 * by linear interpolation, by cubic one more: 0.641 instead of 0.5 at half a pixel. */
struct ResamplingSettings
{
  /** [pixel], -1000 to 1000. */
  double shiftXPixels{ 0.0 };
  /** [pixel], -1000 to 1000. */
  double shiftYPixels{ 0.0 };
  /** Linear or Cubic. */
  Interpolation interpolation{ Interpolation::Linear };

  bool
  IsOn() const
  {
    return shiftXPixels != 0.0 || shiftYPixels != 0.0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResamplingSettings & settings);

/** \a codesDn moved [DN]. */
SensorNoise_EXPORT DoubleFrame
ResampleFrame(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
