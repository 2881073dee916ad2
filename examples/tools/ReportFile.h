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

/** A report that was read and does not serve: another schema, or without what is needed. */
class UnfitReport : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** The JSON record that estimate-sensor-noise --json wrote. Throws std::runtime_error if \a file cannot be read or is
 * no JSON, and UnfitReport if it has another schema. */
nlohmann::json
ReadReportRecord(const std::string & file);

/** A number, or nothing where there is null, another type, or no such member. */
std::optional<double>
NumberIn(const nlohmann::json & record, const char * name);

} // namespace sensornoise::tools

#endif
