// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_RemainingSceneChange_h
#define sensornoise_correlation_RemainingSceneChange_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"

namespace sensornoise
{

/** Returns the fraction of the mean noise variance that is caused by local motion of the scene, along both axes
 * together [1].
 *
 * A small displacement d that neighbours have in common causes the covariance d^2 (grad u(p) . grad u(q)) of two
 * pixels. It depends on the slopes of the scene u at both pixels; the covariance that a filter causes does not. The
 * estimate uses pairs of neighbours within the tiles of the sample. Estimator.md, 3.12. */
SensorNoise_EXPORT MeasuredNumber
FindLocalMotion(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

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
