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

/** A coefficient of neighbours that oscillates with their place: what a frame of fewer samples than pixels leaves. A
 * filter shares alike at every place (Popescu and Farid 2005). */
struct EnlargementTrace
{
  int    lag{ 0 };               ///< how far the neighbours are apart [pixels]
  bool   isAlongX{ false };      ///< along which axis they are apart, and their coefficient oscillates
  bool   isAlternating{ false }; ///< with the opposite sign in every other line
  double cyclesPerPixel{ 0.0 };
  double amplitude{ 0.0 }; ///< [1]
};

/** The largest oscillation, if it exceeds chance and is of a size that only fewer samples leave. */
SensorNoise_EXPORT std::optional<EnlargementTrace>
FindEnlargementTrace(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
