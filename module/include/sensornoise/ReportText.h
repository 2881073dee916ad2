// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_ReportText_h
#define sensornoise_ReportText_h

#include "SensorNoiseExport.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <string>
#include <vector>

/** \file
 * Writes a report as JSON and as a table, and lists its quantities. */

namespace sensornoise
{

/** Condition for a row of a quantity in the table. The JSON record has all quantities. */
enum class ShownIn : std::uint8_t
{
  EveryTable,        ///< shown if the report has the quantity, with or without a value
  TableIfKnown,      ///< shown if the quantity has a value
  TableIfNotTheGain, ///< shown if the quantity has a value that differs from the value of the gain
  TableIfLimited,    ///< shown if the quantity has a value or an upper limit
  Record             ///< never shown
};

/** Description of one quantity of a report. */
struct QuantityEntry
{
  const char *   path;    ///< path in the JSON record; a dot leads into an object: "vibration.sd_x"
  const char *   label;   ///< label in the table
  const char *   unit;    ///< "DN", "DN^2", "DN/e-", "e-", "pixel", "pixel^2", "%", "DN/unit" or "1"
  const char *   meaning; ///< description in one or more sentences
  ShownIn        shown;   ///< condition for a row in the table
  QuantityDomain domain;  ///< possible values, which decide on the status
  /** Returns the quantity of a report; null: the report has no object with this quantity. */
  const Quantity * (*of)(const Report & report);
};

/** Returns all quantities, in the order of the table. JSON, table, Python package and
 * documentation/reference/quantities.md are generated from this list, or tested against it. */
SensorNoise_EXPORT const std::vector<QuantityEntry> &
QuantityList();

/** Returns WarningTable and QuantityList() as JSON, for other languages:
 * {"warnings": [{"code", "severity", "sentence"}, ...], "quantities": [{"path", "label", "unit", "meaning"}, ...]}. */
SensorNoise_EXPORT std::string
CatalogueAsJson();

/** Name and version of the schema of the JSON record. */
inline constexpr const char * ReportSchema = "itk-sensornoise-report/1";

/** Returns the name of the status in the JSON record, for example "not-identifiable". */
SensorNoise_EXPORT const char *
NameOf(EstimateStatus status);

/** Returns the report as a JSON object, schema "itk-sensornoise-report/1". Each quantity has its unit; unknown values
 * are null. */
SensorNoise_EXPORT std::string
ToJson(const Report & report);

/** Returns the report as a table for people, one line per quantity, without the warnings. */
SensorNoise_EXPORT std::string
MakeTable(const Report & report);

/** Returns the warning as a line, with its line break: "warning: message [code]". The first word is the severity:
 * "note", "warning" or "error". */
SensorNoise_EXPORT std::string
TextOf(const Warning & warning);

/** Returns how many of the given frames count, for example " (3 left out, 50 different)"; "" if all count. */
SensorNoise_EXPORT std::string
TextOfCounted(const Report & report);

/** Returns the table and the warnings, one line per warning. */
SensorNoise_EXPORT std::string
MakeText(const Report & report);

/** Returns the reports of a mosaic as one JSON object, schema "itk-sensornoise-report/1". Its members are `schema`,
 * `version`, `input` (if it was requested), `bayer` (`pattern`, `source`), `joint` (`offset`, `precision_gain`,
 * `reduced_chi2`; or null), `joint_vibration` (`sd_x`, `sd_y`, `covariance`, `motion`; or null), `warnings` about all
 * channels, and `channels`: the reports of R, G1, G2 and B, in this order. */
SensorNoise_EXPORT std::string
ToJson(const ChannelReports & reports);

/** Returns the reports of a mosaic as a table for people, one line per channel, as in Table 6 of Sur & Grédiac 2015.
 * The columns are the parameters of the sensor, the motion and the flicker. The joint offset and the joint vibration
 * follow below, if they were measured. The table has no warnings. */
SensorNoise_EXPORT std::string
MakeTable(const ChannelReports & reports);

/** Returns the table and the warnings of WarningsOf(), one line per warning. */
SensorNoise_EXPORT std::string
MakeText(const ChannelReports & reports);

/** Returns all warnings. A warning of a channel has the name of the channel before its message; equal warnings of
 * several channels are joined. */
SensorNoise_EXPORT std::vector<Warning>
WarningsOf(const ChannelReports & reports);

} // namespace sensornoise

#endif
