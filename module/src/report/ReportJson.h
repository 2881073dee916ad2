// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportJson_h
#define sensornoise_report_ReportJson_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

class JsonWriter;

/** The version of the record. */
inline constexpr const char * ReportSchema = "itk-sensornoise-report/1";

/** The JSON name of a status. */
SensorNoise_EXPORT const char *
NameOf(EstimateStatus status);

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

/** The record as JSON, schema "itk-sensornoise-report/1": one object, units in each quantity, null for what is unknown.
 */
SensorNoise_EXPORT std::string
ToJson(const Report & report);

} // namespace sensornoise

#endif
