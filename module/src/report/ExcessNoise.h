// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ExcessNoise_h
#define sensornoise_report_ExcessNoise_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Throws std::invalid_argument unless \a factor is a finite number of 1 or more. */
SensorNoise_EXPORT void
ValidateExcessNoiseFactor(double factor);

/** Divides the excess noise factor F = \a factor out of the gain: g = slope / F, where the slope is that of the
 * variance against the level. Random amplification of each electron by M on average makes the variance F M^2 N of N
 * electrons, whose level is M N: the slope is F M, and a burst alone tells F and M not apart (Robbins & Hadwen 2003,
 * https://doi.org/10.1109/TED.2003.813462). The gain, those of the parts, their errors, its part of the covariance, and
 * the read noise in electrons change; everything in DN stays as it is, variance slope and intercepts included. The
 * factor is noted in the settings. A factor of 1 changes nothing. */
SensorNoise_EXPORT void
DivideExcessNoise(Report & report, double factor);

} // namespace sensornoise

#endif
