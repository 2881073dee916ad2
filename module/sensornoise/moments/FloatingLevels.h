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
#ifndef sensornoise_moments_FloatingLevels_h
#define sensornoise_moments_FloatingLevels_h

#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/OutermostLevels.h"
#include "sensornoise/moments/PileUp.h"
#include "SensorNoiseExport.h"

namespace sensornoise
{

/** Finds the clip levels of floating-point data from every pixel's extremes over time, as FindCodes() those of
 * integers: a clip level is a pile-up of the extremes, that is, many pixels whose extreme is exactly the outermost
 * value.
 *
 * Given values win. There are no codes, and so no end of a code range: where nothing is given and nothing piles up, no
 * pixel is clipped. Frames of codes that were converted, or scaled by one number, pile up as the codes did, and are
 * compared with the levels one step apart. A flat field that is divided out spreads a clip level over many values: then
 * it cannot be found and must be given. \a typicalVarianceDn2 is the median temporal variance of the pixels that vary,
 * see CanTellPileUp().
 * \a minima or \a maxima may be empty where they are known not to pile up. */
SensorNoise_EXPORT CodeRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const CodeSettings &    settings,
           const ExtremeDepths &   depths = {});

} // namespace sensornoise

#endif
