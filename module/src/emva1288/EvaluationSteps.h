// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_EvaluationSteps_h
#define sensornoise_emva1288_EvaluationSteps_h

#include "sensornoise/Emva1288.h"

namespace sensornoise
{

class DarkLevels;
struct TransferCurve;

// The steps of EvaluateEmva1288(). Each of them sets a part of the report.

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

/** Sets dark signal, dark noise (53), (54) and dark current (section 7.1). The dark noise and the dark current in
 * electrons need report.gain. */
void
MeasureDark(const DarkLevels & dark, EmvaReport & report);

/** Sets saturation capacity, sensitivity threshold (26), dynamic range (28) and largest signal-to-noise ratio (55).
 * They need report.gain. In photons they need report.quantumEfficiency. Where no frames are saturated, the
 * saturation has a lower bound and no value. */
void
MeasureRange(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the signal-to-noise ratios of the linear model of all points, (21) and (69). */
void
ModelSnr(const DarkLevels & dark, EmvaReport & report);

/** Sets DSNU1288 (66) and PRNU1288 (67) with their parts of columns, rows and pixels, after the highpass filter and
 * without it, and the series that they are measured of.
 *
 * The bright series is the one with the most frames; of equal ones the one whose signal is nearest to half of \a
 * saturationSignalDn [DN]. The dark series is the one with the most frames; of equal ones the one whose exposure is
 * nearest to the bright series. All are from report.series. A variance that is not distinguished from 0 gives an upper
 * limit. The standard errors are those of white patterns. DSNU needs report.gain. */
void
MeasureNonUniformity(const DarkLevels & dark, double saturationSignalDn, EmvaReport & report);

/** Measures the linearity of section 6.7: line, deviations, and linearity error.
 *
 * The line through the signals from 5 to 95 % of saturation has the least relative deviations (58) to (61). The
 * deviations are relative to the line (62), and the linearity error is the mean of their absolute values (63). Its
 * standard error follows from the scatter of frames of equal exposure. The corrected linearity error is without the
 * contribution of noise, see FitExposures(). Sets the deviations of report.points. Leaves all unset if fewer than three
 * points are in the range. */
void
MeasureLinearity(const TransferCurve & curve, EmvaReport & report);

} // namespace sensornoise

#endif
