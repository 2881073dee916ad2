// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_GainFits_h
#define sensornoise_emva1288_GainFits_h

#include "sensornoise/Emva1288.h"

namespace sensornoise
{

class DarkLevels;
struct TransferCurve;

/** Sets the system gain K: the slope of the variance against the signal, both less those of the dark frames, by a line
 * with an offset and equal weights (50). The range is 0 to 70 % of saturation. Also sets the slope of the line without
 * an offset. Leaves both unset if fewer than three points are in the range. */
void
MeasureGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the weighted estimate of the system gain: the slope of a line through the variances of all flat series in this
 * range and of all dark series, against their means.
 *
 * Each variance has the weight 1 / (2 V^2 / (pixels (frames - 1))), with V the value of the line. The electrons of the
 * dark current are on the same line. */
void
MeasureWeightedGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the responsivity (49), a line through the origin in the same range, and the quantum efficiency (52). Leaves
 * both unset if the photons are not known. */
void
MeasureResponsivity(const TransferCurve & curve, EmvaReport & report);

} // namespace sensornoise

#endif
