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

/** The mean square of what moves in places by itself, along both axes together, in units of the mean variance of the
 * noise [1]: small displacements d that neighbours have in common make the covariance d^2 (grad u(p) . grad u(q)) of
 * two pixels, which depends on the slopes of the scene u at both. A filter knows nothing of them. By pairs of
 * neighbours within the tiles of the sample. Estimator.md, 3.12. */
SensorNoise_EXPORT MeasuredNumber
FindLocalMotion(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
