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
 * A report as JSON and as a table, and the list of its quantities. */

namespace sensornoise
{

/** When the table for people has a line for a quantity; the JSON record has all of them. */
enum class ShownIn : std::uint8_t
{
  EveryTable,
  TableIfKnown,      ///< where it has a value
  TableIfNotTheGain, ///< where it has a value that is not the gain's
  TableIfLimited,    ///< where it has a value or an upper limit
  Record             ///< never
};

/** One quantity of a report: where it is and what it is called. */
struct QuantityEntry
{
  const char *   path;    ///< in the JSON record; a dot leads into an object: "vibration.sd_x"
  const char *   label;   ///< in the table
  const char *   unit;    ///< "DN", "DN^2", "DN/e-", "e-", "pixel", "pixel^2", "%", "DN/unit", "1"
  const char *   meaning; ///< one sentence
  ShownIn        shown;
  QuantityDomain domain; ///< its possible values, by which FileStatuses() files it
  /** The quantity; null in a report that has no such object. */
  const Quantity * (*of)(const Report & report);
};

/** Returns all quantities, in the order of the table. JSON, table, Python and documentation/reference/quantities.md are
 * generated from this list, or tested against it. */
SensorNoise_EXPORT const std::vector<QuantityEntry> &
QuantityList();

/** WarningTable and QuantityList() as JSON, for other languages:
 * {"warnings": [{"code", "severity", "sentence"}, ...], "quantities": [{"path", "label", "unit", "meaning"}, ...]}. */
SensorNoise_EXPORT std::string
CatalogueAsJson();

/** The version of the record. */
inline constexpr const char * ReportSchema = "itk-sensornoise-report/1";

/** The JSON name of a status. */
SensorNoise_EXPORT const char *
NameOf(EstimateStatus status);

/** The record as JSON, schema "itk-sensornoise-report/1": one object, units in each quantity, null for what is unknown.
 */
SensorNoise_EXPORT std::string
ToJson(const Report & report);

/** The report as a table that a person can read: what was found, one line a quantity, no warnings. */
SensorNoise_EXPORT std::string
MakeTable(const Report & report);

/** A warning as a line: "warning: message [code]", with "note" or "error" where its severity is that. */
SensorNoise_EXPORT std::string
TextOf(const Warning & warning);

/** " (3 left out, 50 different)", of the frames given; "" where all are counted. */
SensorNoise_EXPORT std::string
TextOfCounted(const Report & report);

/** The table and, a line each, what the user should know: for those who see nothing else. */
SensorNoise_EXPORT std::string
MakeText(const Report & report);

/** The reports of a mosaic's channels as one JSON record, schema "itk-sensornoise-report/1": `bayer` (`pattern`,
 * `source`), `joint` (`offset`, `precision_gain`, `reduced_chi2`; or null), `warnings` of all together, and `channels`,
 * a record each in the order R, G1, G2, B, which says its name in `channel`. */
SensorNoise_EXPORT std::string
ToJson(const ChannelReports & reports);

/** The same as a table that a person can read: a line a channel, as Table 6 of Sur & Grédiac 2015 has them, after the
 * parameters of the sensor the motion and the flicker; then the joint offset. No warnings. */
SensorNoise_EXPORT std::string
MakeTable(const ChannelReports & reports);

/** The table and, a line each, what the user should know of all channels and of each. */
SensorNoise_EXPORT std::string
MakeText(const ChannelReports & reports);

/** All warnings, those of a channel with its name before the sentence; what several say alike is said once. */
SensorNoise_EXPORT std::vector<Warning>
WarningsOf(const ChannelReports & reports);

} // namespace sensornoise

#endif
