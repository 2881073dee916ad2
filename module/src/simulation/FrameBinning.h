// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameBinning_h
#define sensornoise_simulation_FrameBinning_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"
#include "simulation/Interpolation.h"

namespace sensornoise
{

/** Binning in the camera, and frames of the full size made of it again: the mean of each square of pixels, the squares
 * at the right and at the bottom cut by the edge, then interpolated at the old pixels between the squares' centres.
 * White noise keeps 1 / factor^2 of its variance by "nearest"; by "linear" a pixel has less. */
struct BinningSettings
{
  /** Side of the square [pixel], 1 to 64; 1: none. */
  unsigned int factor{ 1 };
  /** Nearest (the square's pixels are equal) or Linear. */
  Interpolation interpolation{ Interpolation::Nearest };

  bool
  IsOn() const
  {
    return factor > 1;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const BinningSettings & settings);

/** \a codesDn binned, in its old size [DN]. Where whole squares fill the frame, its mean is kept. */
SensorNoise_EXPORT DoubleFrame
BinFrame(const DoubleFrame & codesDn, const BinningSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
