// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_limits_CramerRaoBound_h
#define sensornoise_limits_CramerRaoBound_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "limits/CramerRaoInput.h"
#include "limits/PrecisionLimit.h"

namespace sensornoise
{

/** Computes the Cram\'er-Rao bound of a simulated stack in the model of ComputePrecisionLimit(). The flux of every
 * pixel, and the flicker and shift of every frame, are unknown. Both the mean and the variance of every datum
 * contribute information. The flicker is (1 + gamma_t) / mean(1 + gamma) - 1, and the shifts are relative to their
 * mean: the remaining scale and position of the scene cannot be identified from a stack.
 *
 * The effect of a shift on a pixel, the derivative of the interpolated scene, is taken as known. An estimator has only
 * the noisy gradients of the frames, so the bound for the vibrations is slightly too small.
 *
 * The cost is 9 T^2 operations per pixel, 4 s on one core for 512 x 512 pixels and 100 frames. \a parallelFor
 * distributes it over up to 8 threads, with the same bits for any number of threads. Memory: 8 times 72 T^2 bytes.
 *
 * \throws std::invalid_argument for one frame, a rolling shutter, or data without any noise in the dark. */
SensorNoise_EXPORT PrecisionLimit
ComputeCramerRaoBound(const CramerRaoInput & input, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
