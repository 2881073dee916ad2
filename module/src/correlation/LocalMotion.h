// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_LocalMotion_h
#define sensornoise_correlation_LocalMotion_h

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

} // namespace sensornoise

#endif
