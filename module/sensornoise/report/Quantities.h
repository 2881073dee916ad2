// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Quantities_h
#define sensornoise_report_Quantities_h

#include "SensorNoiseExport.h"
#include "sensornoise/report/Report.h"

namespace sensornoise
{

/** A value with its standard error and 95 % interval. */
SensorNoise_EXPORT Quantity
WithError(double value, double standardError, double student = 1.96);

/** What is not distinguishable from 0: no value, and an interval up to \a high. */
SensorNoise_EXPORT Quantity
UpperLimit(double high);

/** A root of a squared quantity: its interval is the root of the square's, cut at 0; an interval that holds 0 gives an
 * upper limit and no value, and noise that carried the square below 0 does not lower it. */
SensorNoise_EXPORT Quantity
RootOf(double square, double standardError, double student = 1.96);

/** Marks every parameter of the sensor \a status, without a value. */
SensorNoise_EXPORT void
SetSensorParameters(Report & report, EstimateStatus status);

} // namespace sensornoise

#endif
