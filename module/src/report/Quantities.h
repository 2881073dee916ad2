// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Quantities_h
#define sensornoise_report_Quantities_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Largest standard error of an identified positive quantity, relative to its value [1]. Chosen by the size of the
 * effect: with a larger error one value in three is wrong by more than half of itself, and gives only the order of
 * magnitude. */
inline constexpr double LargestRelativeError = 0.5;
/** Largest width of the 95 % interval of an identified offset, relative to the signal of the brightest pixels [1].
 * Chosen by the size of the effect: with a wider interval every signal, and with it the flicker, is uncertain by 1/8 or
 * more. */
inline constexpr double LargestOffsetInterval = 0.25;

/** Returns the quantity with its final status, by its domain. All estimated quantities get their status here.
 *
 * A positive quantity is `identified` if its 95 % interval excludes 0 and its standard error is at most
 * LargestRelativeError times its value. If the interval contains 0 and the domain is QuantityDomain::NonNegative, it is
 * an `upper-limit`. Otherwise it is `not-identifiable`.
 *
 * An offset is `failed` if its interval does not overlap its bounds (Quantity::bracket). It is `identified` if the
 * width of the interval is at most LargestOffsetInterval times \a signalDn, the signal of the brightest pixels [DN].
 * Otherwise it is `not-identifiable`.
 *
 * A quantity of any sign is `identified` if its interval has two bounds, and otherwise `not-identifiable`.
 *
 * A quantity that becomes `not-identifiable` keeps its bounds, or gets its interval as bounds. A quantity that is not
 * `identified`, or has no value or no interval, is returned unchanged. The published method gives no intervals. */
SensorNoise_EXPORT Quantity
Filed(const Quantity & quantity, QuantityDomain domain, double signalDn = 0.0);

/** Returns an identified quantity with its standard error and its 95 % interval: \a value +- \a student times
 * \a standardError. \a student is the 97.5 % quantile of Student's distribution [1], by default for many degrees of
 * freedom. */
SensorNoise_EXPORT Quantity
WithError(double value, double standardError, double student = 1.96);

/** Returns a quantity that is not distinguished from 0: it has no value, and interval and bounds from 0 to \a high. */
SensorNoise_EXPORT Quantity
UpperLimit(double high);

/** Returns the square root of an estimate with its final status, see Filed(), as a quantity of 0 or more. \a
 * standardError is the standard error of \a square. The 95 % interval contains the roots of the interval of the square;
 * negative values count as 0. A negative estimate does not lower the upper limit. */
SensorNoise_EXPORT Quantity
RootOf(double square, double standardError, double student = 1.96);

/** Sets the status of all parameters of the sensor, and removes their values: gain, variance slope, offset, read noise
 * (also in electrons), intercept and total intercept. */
SensorNoise_EXPORT void
SetSensorParameters(Report & report, EstimateStatus status);

/** Least reduced chi-square of the variance about its line for which the gain is valid [1]. Below it the variance
 * scatters less than chance allows, and the line is wrong. Chosen empirically on 121 simulated bursts under changing
 * illumination: the least value with a correct gain was 0.50, and gains that were wrong by more than 10 % had 0.003 to
 * 0.1. Each method has its own upper limit, because responses may be non-linear. */
inline constexpr double LeastReducedChi2 = 0.2;
/** Largest standard deviation of the motion along an axis that is reported [pixel]. A larger vibration is not a motion
 * of the scene, but for example the flicker of a ramp, which looks like a shift. Chosen empirically: no motion was
 * measured in simulated scenes that moved this far. */
inline constexpr double LargestVibrationPixels = 5.0;

/** Gives each quantity of the report its final status.
 *
 * First it withdraws the quantities that the report contradicts. Offset and read noise become `failed` after the
 * warning `dark-frames-differ` or `offset-out-of-range`. A vibration above LargestVibrationPixels becomes `failed`. A
 * gain whose reduced chi-square is below LeastReducedChi2 becomes `failed`, and a gain that Filed() does not identify
 * gets the status from there. All parameters of the sensor then get the status of the gain, and the warning
 * `contradicted` is added.
 *
 * Then all quantities of QuantityList() pass Filed(). If this withdraws the offset, the read noise gets the status of
 * the offset. A second call changes nothing. */
SensorNoise_EXPORT void
FileStatuses(Report & report);

} // namespace sensornoise

#endif
