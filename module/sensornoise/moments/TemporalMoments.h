/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_moments_TemporalMoments_h
#define sensornoise_moments_TemporalMoments_h

#include "sensornoise/moments/FloatingMoments.h"
#include "sensornoise/moments/IntegerMoments.h"

#include <type_traits>

namespace sensornoise
{

/** The temporal moments for a pixel type: exact sums for integers, Welford's recurrence for floating point. */
template <typename TPixel>
using TemporalMoments = std::conditional_t<std::is_integral_v<TPixel>, IntegerMoments<TPixel>, FloatingMoments<TPixel>>;

} // namespace sensornoise

#endif
