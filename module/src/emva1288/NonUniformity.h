// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_NonUniformity_h
#define sensornoise_emva1288_NonUniformity_h

#include "sensornoise/Emva1288.h"

namespace sensornoise
{

class DarkLevels;

/** Sets DSNU1288 (66) and PRNU1288 (67) with their parts of columns, rows and pixels, after the highpass filter and
 * without it, and the series that they are measured of.
 *
 * The bright series is the one with the most frames; of equal ones the one whose signal is nearest to half of \a
 * saturationSignalDn [DN]. The dark series is the one with the most frames; of equal ones the one whose exposure is
 * nearest to the bright series. All are from report.series. A variance that is not distinguished from 0 gives an upper
 * limit. The standard errors are those of white patterns. DSNU needs report.gain. */
void
MeasureNonUniformity(const DarkLevels & dark, double saturationSignalDn, EmvaReport & report);

} // namespace sensornoise

#endif
