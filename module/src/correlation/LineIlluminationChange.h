// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_LineIlluminationChange_h
#define sensornoise_correlation_LineIlluminationChange_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"

namespace sensornoise
{

/** Returns the mean square of a relative change of the illumination that is common to the pixels of a line (row or
 * column) in a frame [1]. It is what the temporal components left in the residuals.
 *
 * It is caused by a pulsed lamp under a rolling shutter, or by interlaced frames. The covariance of pixels in a line
 * that a change of the illumination causes grows with the squared signal. The noise of whole lines does not depend on
 * the signal, which distinguishes both. Returns 0 with an infinite error where the signals do not differ enough.
 * Estimator.md, 3.12. */
SensorNoise_EXPORT MeasuredNumber
EstimateLineIlluminationChange(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
