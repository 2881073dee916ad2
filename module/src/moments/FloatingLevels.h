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

/** Finds the clip levels of floating-point data from the extremes of every pixel over time, as FindCodes() does for
 * integers. A clip level is a pile-up of the extremes: many pixels have exactly the outermost value as extreme.
 *
 * Given values take precedence. Floating-point data have no DN range: where nothing is given and nothing piles up, no
 * pixel is clipped. Converted codes, and codes scaled by one number, pile up like the codes, and are compared with the
 * levels one step apart. The division by a flat field spreads a clip level over many values; then it cannot be found
 * and must be given.
 *
 * \a typicalVarianceDn2 is the median temporal variance of the pixels that vary [DN^2], see IsPileUpEvidence(). \a
 * minima or \a maxima may be empty if they are known to have no pile-up. */
SensorNoise_EXPORT CodeRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const CodeSettings &    settings,
           const ExtremeDepths &   depths = {});

} // namespace sensornoise

#endif
