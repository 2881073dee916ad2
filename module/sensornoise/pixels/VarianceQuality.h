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
#ifndef sensornoise_pixels_VarianceQuality_h
#define sensornoise_pixels_VarianceQuality_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cstdint>
#include <vector>

/** \file
 * Whether the line is all there is to the variance, in the smoother half of the scene, too. */

namespace sensornoise
{

class ProjectedVariance;

/** The line through the smoother half of the pixels, where motion could do least. */
SensorNoise_EXPORT VarianceLine
FitFlatHalf(const ProjectedVariance &         projected,
            const std::vector<std::uint8_t> & mask,
            const VarianceLine &              line,
            const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
