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
#ifndef sensornoise_refined_DarkPoint_h
#define sensornoise_refined_DarkPoint_h

#include "SensorNoiseExport.h"
#include "sensornoise/refined/RefinedResults.h"

namespace sensornoise
{

struct GainEstimate;

/** Adds what dark frames tell: the line goes through their offset and variance, (mu, sigma^2). With levels of one
 * height only this is the photon transfer of EMVA 1288, gain = (V - sigma^2) / (mean - mu).
 *
 * Dark frames that contradict a straight line which comes close to the dark are of another sensor, and not used.
 * Elsewhere, where dark frames and frames contradict each other, or the levels' gains (V - sigma^2) / (mean - mu)
 * differ, beyond chance, the response bends: then the gain is their mean, and their scatter its error. */
SensorNoise_EXPORT void
UseDarkPoint(GainEstimate & estimate, const RefinedResults & found);

} // namespace sensornoise

#endif
