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

/** What the record is made of, as JSON. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Interval & interval);
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Warning & warning);
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const LeftOutFrame & frame);
/** A quantity as member \a name of an object. */
SensorNoise_EXPORT void
WriteQuantity(JsonWriter & json, const char * name, const Quantity & quantity, const char * unit);
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Lag & lag);
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Line & line);
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord & correlation);

/** `of`, which is "files" or "pixels", their `sha256` (null: not computed), `files` and `bytes`, and of dark frames the
 * same in `dark`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const InputRecord & input);

/** The record as a value among others. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Report & report);

} // namespace sensornoise

#endif
