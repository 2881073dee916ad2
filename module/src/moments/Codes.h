// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Codes_h
#define sensornoise_moments_Codes_h

#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/ExtremeLevels.h"
#include "SensorNoiseExport.h"

#include <cstdint>

namespace sensornoise
{

/** Returns the outermost code of \a extremes that is not due to stray pixels [DN].
 *
 * This is the highest or the lowest code, unless only few pixels have a code beyond a pile-up, see IsClipLevel(),
 * separated from it by a gap. Then the pile-up is the end: a stuck pixel does not hide the saturation level of the
 * others. \a step is the quantization step [DN]. The histogram must not be empty. */
SensorNoise_EXPORT std::int32_t
FindEndOfCodes(const CodeHistogram & extremes, bool isHigh, double step);

/** Finds the bit depth, the quantization step and the clip levels of integer data from the extremes of every pixel over
 * time.
 *
 * Given values take precedence. The bit depth is the smallest of 8, 10, 12, 14 and 16 that holds the codes. A clip
 * level is a pile-up of the extremes, else the end of the DN range. Many sensors saturate below this end, for example
 * at 3,400 of 4,095, or never fall to 0. \a typicalVarianceDn2 is the median temporal variance of the pixels that vary
 * [DN^2]. Where a pile-up is not evidence of clipping, see IsClipEvidence(), the end of the DN range is used.
 *
 * Throws std::invalid_argument if the stack holds no pixel, or a level above the bit depth. */
SensorNoise_EXPORT CodeRange
FindCodes(const CodeHistogram & minima,
          const CodeHistogram & maxima,
          double                typicalVarianceDn2,
          const CodeSettings &  settings,
          const ExtremeDepths & depths = {});

/** Returns the given settings only: floating-point data have no codes. */
SensorNoise_EXPORT CodeRange
GivenCodes(const CodeSettings & settings);

/** Finds the clip levels of floating-point data from the extremes of every pixel over time, as FindCodes() does for
 * integers. A clip level is a pile-up of the extremes: many pixels have exactly the outermost value as extreme.
 *
 * Given values take precedence. Floating-point data have no DN range: where nothing is given and nothing piles up, no
 * pixel is clipped. Converted codes, and codes scaled by one number, pile up like the codes, and are compared with the
 * levels one step apart. The division by a flat field spreads a clip level over many values; then it cannot be found
 * and must be given.
 *
 * \a typicalVarianceDn2 is the median temporal variance of the pixels that vary [DN^2], see IsClipEvidence(). \a
 * minima or \a maxima may be empty if they are known to have no pile-up. */
SensorNoise_EXPORT CodeRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const CodeSettings &    settings,
           const ExtremeDepths &   depths = {});

} // namespace sensornoise

#endif
