// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Quantities_h
#define sensornoise_report_Quantities_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Standard error of a positive quantity that is a number, relative to its value [1]. Chosen: a number that is wrong by
 * half of itself once in three times says no more than its order of magnitude. */
inline constexpr double LargestRelativeError = 0.5;
/** Width of the 95 % interval of an offset that is a number, relative to the signal of the brightest pixels [1].
 * Chosen: an offset that is less certain leaves every signal, and so the flicker, uncertain by an eighth or more. */
inline constexpr double LargestOffsetInterval = 0.25;

/** The rule by which a quantity that was estimated is identified, or is not. The one place where that is decided.
 *
 * A positive quantity is `identified` if its 95 % interval excludes 0 and its standard error is at most
 * LargestRelativeError of it. Otherwise it is an `upper-limit` where the interval holds 0 and 0 is one of its values
 * (QuantityDomain::NonNegative), else `not-identifiable`, and its interval becomes its bracket. An offset, of which 0
 * is a value like others, is `identified` if its interval overlaps its bracket, else `failed`, and if the interval is
 * narrower than LargestOffsetInterval of \a signalDn, the signal of the brightest pixels. A quantity of any sign needs
 * an interval with two ends. A quantity without an interval, as the published method has, or without a value, is
 * returned as it is. */
SensorNoise_EXPORT Quantity
Filed(const Quantity & quantity, QuantityDomain domain, double signalDn = 0.0);

/** A value with its standard error and 95 % interval. */
SensorNoise_EXPORT Quantity
WithError(double value, double standardError, double student = 1.96);

/** What is not distinguishable from 0: no value, and an interval up to \a high. */
SensorNoise_EXPORT Quantity
UpperLimit(double high);

/** A root of a squared quantity, Filed() as one that is not negative: its interval is the root of the square's, cut at
 * 0. Noise that carried the square below 0 does not lower an upper limit. */
SensorNoise_EXPORT Quantity
RootOf(double square, double standardError, double student = 1.96);

/** Marks every parameter of the sensor \a status, without a value. */
SensorNoise_EXPORT void
SetSensorParameters(Report & report, EstimateStatus status);

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
