// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef PassportFile_h
#define PassportFile_h

#include "sweep/Setting.h"
#include "sweep/SweepSummary.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::tools
{

/** Name and version of the schema of a passport: the reports of a camera at all its settings. */
inline constexpr const char * PassportSchema = "itk-sensornoise-passport/1";

/** One setting of a passport. */
struct PassportEntry
{
  std::string           name; ///< name of the burst: its folder or its file
  std::optional<double> setting;
  std::string           reason;  ///< reason why it was not measured; "": it was measured
  std::string           options; ///< the options that change numbers, as they were given
  nlohmann::json        report;  ///< the record of the report; null: it could not be measured
};

/** The noise of a camera at all its settings. */
struct Passport
{
  std::string                name; ///< name of the file, for messages; "": the passport is not from a file
  SettingKind                kind{ SettingKind::Iso };
  std::vector<PassportEntry> entries;
  std::optional<std::pair<double, double>> switchBetween;
  std::map<double, double>                 offLine; ///< settings that leave the line of the gains, see MeasuredRange
};

/** Returns whether a JSON record says that it is a passport. */
bool
IsPassport(const nlohmann::json & record);

/** Reads a passport that estimate-sensor-noise --sweep wrote. Throws std::runtime_error if the file cannot be read or
 * is no JSON, and UnfitReport if it is no passport, or a part of it is missing. */
Passport
ReadPassport(const std::string & file);

/** Returns the measured settings in ascending order, by AddSetting(). Throws ExportError as ReadCameraNoise(). */
MeasuredRange
RangeOf(const Passport & passport, const ExportSettings & settings = {});

/** Returns the settings that were not measured. */
std::vector<UnmeasuredSetting>
UnmeasuredOf(const Passport & passport);

/** Returns the passport as JSON, with the numbers of its summary. */
std::string
ToJson(const Passport & passport, const SweepSummary & summary);

} // namespace sensornoise::tools

#endif
