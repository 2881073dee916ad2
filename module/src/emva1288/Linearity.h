// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_Linearity_h
#define sensornoise_emva1288_Linearity_h

#include "sensornoise/Emva1288.h"

namespace sensornoise
{

struct TransferCurve;

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
