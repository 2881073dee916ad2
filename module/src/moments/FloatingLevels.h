// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FloatingLevels_h
#define sensornoise_moments_FloatingLevels_h

#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/OutermostLevels.h"
#include "moments/PileUp.h"
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
