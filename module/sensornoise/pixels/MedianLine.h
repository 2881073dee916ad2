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
#ifndef sensornoise_pixels_MedianLine_h
#define sensornoise_pixels_MedianLine_h

#include "SensorNoiseExport.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <optional>

namespace sensornoise
{

class ChiSquareTrim;

/** A first line, through the medians of 40 bins of the intensity; \a trim knows the medians of all degrees of freedom.
 * Null with one intensity. */
SensorNoise_EXPORT std::optional<VarianceLine>
FitMedians(const VarianceData & data, const ChiSquareTrim & trim);

} // namespace sensornoise

#endif
