// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_VibrationCovariance_h
#define sensornoise_published_VibrationCovariance_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Fits the multiple ordinary regression (2.20) of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035):
 *
 *     Var(u) = c0 + c1 ubar + sigma_gamma^2 ubar^2 + (1 + sigma_gamma^2) grad ubar' Cov(alpha, beta) grad ubar
 *
 * over all inner pixels that are \a valid (null: all) and finite, including those moved by vibrations. \a mean [DN] and
 * \a variance [DN^2] are maps of the uncorrected stack, flicker included. \a flickerSd is sigma_gamma if it is known
 * from the flicker itself [1]. Below 0 it is the square root of this regression's own coefficient (0 if the coefficient
 * is negative). */
SensorNoise_EXPORT VibrationCovariance
FitVibrationCovariance(const double *       mean,
                       const double *       variance,
                       const std::uint8_t * valid,
                       std::size_t          width,
                       std::size_t          height,
                       double               flickerSd,
                       const ParallelFor &  parallelFor = SerialFor);

} // namespace sensornoise

#endif
