// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Statuses_h
#define sensornoise_report_Statuses_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** The variance's reduced chi-square about its line, below which the line is not that of the variance: it scatters less
 * than chance allows [1]. Chosen empirically: of 121 simulated bursts under changing illumination whose gain was right
 * the least was 0.50; those whose gain was wrong by more than a tenth had 0.003 to 0.1. How much more than by chance it
 * may scatter depends on the method, as responses bend. */
inline constexpr double LeastReducedChi2 = 0.2;
/** Standard deviation of the motion along an axis beyond which it is no motion of the scene [pixel]: the flicker of a
 * ramp looks like it. Chosen empirically: where a simulated scene moved by so much, none was measured. */
inline constexpr double LargestVibrationPixels = 5.0;

/** Gives each quantity of the report its final status. First every quantity that a warning of the report contradicts
 * becomes `failed`: offset and read noise after `dark-frames-differ`, and `offset-out-of-range`, and a vibration that
 * is too large to be one. Then all quantities of QuantityList() pass Filed(). Without its gain a report keeps no
 * parameter of the sensor, and has the warning `contradicted`; without its offset it keeps no read noise that depends
 * on the offset. The function may be called again: it changes nothing then.
 */
SensorNoise_EXPORT void
FileStatuses(Report & report);

} // namespace sensornoise

#endif
