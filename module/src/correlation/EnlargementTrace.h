// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_EnlargementTrace_h
#define sensornoise_correlation_EnlargementTrace_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseResiduals.h"

#include <optional>

namespace sensornoise
{

/** Oscillation of a noise correlation coefficient with the position in the frame. Frames with fewer samples than pixels
 * have it; after a filter the correlation is the same at every position (Popescu and Farid 2005). */
struct EnlargementTrace
{
  int    lag{ 0 };               ///< distance of the neighbours [pixels]
  bool   isAlongX{ false };      ///< whether the neighbours lie, and their coefficient oscillates, along x
  bool   isAlternating{ false }; ///< whether the sign alternates from line to line
  double cyclesPerPixel{ 0.0 };
  double amplitude{ 0.0 }; ///< amplitude of the coefficient [1]
};

/** Returns the largest oscillation, if it is significant and exceeds InCorrelation.leastOscillation, which only frames
 * with fewer samples than pixels do. */
SensorNoise_EXPORT std::optional<EnlargementTrace>
FindEnlargementTrace(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
