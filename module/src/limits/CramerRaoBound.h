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

/** The Cram\'er-Rao bound of a simulated stack, in the model that ComputePrecisionLimit() states: every pixel's flux,
 * every frame's flicker and every frame's shift are unknown. Mean and variance of every datum both count. The flicker
 * is (1 + gamma_t) / mean(1 + gamma) - 1 and the shifts are those less their mean: the rest is the scale and the
 * position of the scene, which no stack can tell.
 *
 * The shift's effect on a pixel is taken as known but for its size (the derivative of the interpolated scene), so the
 * vibrations' bound is a little too small: an estimator has only the frames' own noisy gradients.
 *
 * The work is 9 T^2 operations a pixel, 4 s of one core for 512 x 512 pixels and 100 frames; \a parallelFor spreads it
 * over up to 8 threads, with the same bits for any number. Memory: 8 times 72 T^2 bytes.
 *
 * \throws std::invalid_argument for one frame, a rolling shutter, or data without any noise in the dark. */
SensorNoise_EXPORT PrecisionLimit
ComputeCramerRaoBound(const CramerRaoInput & input, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
