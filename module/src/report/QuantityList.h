// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_QuantityList_h
#define sensornoise_report_QuantityList_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <vector>

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

/** All quantities, in the order of the table. JSON, table, Python and README are made of this list, or tested against
 * it. */
SensorNoise_EXPORT const std::vector<QuantityEntry> &
QuantityList();

} // namespace sensornoise

#endif
