// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_LineLight_h
#define sensornoise_correlation_LineLight_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"

namespace sensornoise
{

/** Returns the mean square of the relative changes of the illumination that the pixels of a line share in a frame, and
 * that the series of the scene left in the residuals [1].
 *
 * A lamp that pulses under a rolling shutter, and interlaced frames, leave it. What the pixels of a line share grows
 * with the square of the light; the noise of lines does not, which tells one from the other. 0, with an infinite error,
 * where the levels do not differ enough for that. Estimator.md, 3.12. */
SensorNoise_EXPORT MeasuredNumber
FindLineLight(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
