// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_TemporalMoments_h
#define sensornoise_moments_TemporalMoments_h

#include "moments/FloatingMoments.h"
#include "moments/IntegerMoments.h"

#include <type_traits>

namespace sensornoise
{

/** The temporal moments for a pixel type: exact sums for integers, Welford's recurrence for floating point. */
template <typename TPixel>
using TemporalMoments = std::conditional_t<std::is_integral_v<TPixel>, IntegerMoments<TPixel>, FloatingMoments<TPixel>>;

} // namespace sensornoise

#endif
