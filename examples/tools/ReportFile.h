// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ReportFile_h
#define ReportFile_h

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{

/** Error for a report that can be read but not used: it has another schema, or lacks a required value. */
class UnfitReport : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Reads a JSON file that estimate-sensor-noise wrote. Throws std::runtime_error if \a file cannot be read or is not
 * JSON. */
nlohmann::json
ReadJsonFile(const std::string & file);

/** Reads the JSON record that estimate-sensor-noise --json wrote. Throws std::runtime_error if \a file cannot be
 * read or is not JSON, and UnfitReport if it has another schema. */
nlohmann::json
ReadReportRecord(const std::string & file);

/** Returns a member as a number. It is empty if the member is null, of another type, or missing. */
std::optional<double>
NumberIn(const nlohmann::json & record, const char * name);

} // namespace sensornoise::tools

#endif
