// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_NarrowSums_h
#define sensornoise_pixels_NarrowSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <optional>

namespace sensornoise
{

struct InitialNoiseModel;
struct ReferenceFrame;

/** Returns the norm of the integer series of a TemporalBasis, a power of 2 of at most TemporalBasis::Unit, with which
 * 32 bits are enough for the third pass's sums of integer frames; null: they are not enough.
 *
 * They are enough if the sum of series times deviation from the mean is within 2^31 for every usable pixel of \a frame,
 * and if what the rounded series leave of the illumination and the motion changes the variance by at most
 * InPixels.largestRoundingError of its standard error. \a model gives the noise variance. Estimator.md, 6. */
SensorNoise_EXPORT std::optional<double>
UnitOfNarrowSums(const ReferenceFrame &    frame,
                 const InitialNoiseModel & model,
                 const ParallelFor &       parallelFor = SerialFor);

} // namespace sensornoise

#endif
