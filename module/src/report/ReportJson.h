// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportJson_h
#define sensornoise_report_ReportJson_h

#include "sensornoise/ReportText.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

class JsonWriter;

/** Writes an interval as [low, high]; a bound that does not exist is null. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Interval & interval);
/** Writes a warning as an object: `code`, `severity` and `message`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Warning & warning);
/** Writes a frame that is left out as an object: `frame` (its number from 0) and `reason`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const LeftOutFrame & frame);
/** Writes a quantity as member \a name of the current object. Value, standard error, interval and bounds are in \a
 * unit; unknown values are null. */
SensorNoise_EXPORT void
WriteQuantity(JsonWriter & json, const char * name, const Quantity & quantity, const char * unit);
/** Writes a correlation coefficient as an object. Its `lag` is [x, y] in pixels, or a number of frames. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Lag & lag);
/** Writes the line of the covariance at one lag as an object. Its `lag` is [x, y] in pixels. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Line & line);
/** Writes the noise correlation as an object: noise class (`kind`), coefficients, covariance lines and quantities. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord & correlation);

/** Writes the identification of the input as an object: `of` ("files" or "pixels"), `sha256` (null: not computed),
 * `files` (number) and `bytes`. If there are dark frames, their identification is the member `dark`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const InputRecord & input);

/** Writes the record as an object, without a line break at its end. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Report & report);

} // namespace sensornoise

#endif
