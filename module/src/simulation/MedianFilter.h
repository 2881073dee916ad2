// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_MedianFilter_h
#define sensornoise_simulation_MedianFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

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
