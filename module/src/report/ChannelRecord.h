// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ChannelRecord_h
#define sensornoise_report_ChannelRecord_h

#include "SensorNoiseExport.h"
#include "sensornoise/ChannelReports.h"

#include <string>

namespace sensornoise
{

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
