// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ReportFile.h"

#include "sensornoise/ReportText.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

namespace sensornoise::tools
{
namespace
{
using nlohmann::json;
} // namespace

json
ReadJsonFile(const std::string & file)
{
  const std::string expected = "; expected the JSON file that estimate-sensor-noise --json wrote";
  std::error_code   ignored;
  if (std::filesystem::is_directory(file, ignored))
  {
    throw std::runtime_error("the report " + file + " is a folder" + expected);
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
  {
    throw std::runtime_error("the report " + file + " cannot be read: " + std::generic_category().message(errno) +
                             expected);
  }
  const std::string text{ std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
  json              record = json::parse(text, nullptr, false);
  if (record.is_discarded())
  {
    throw std::runtime_error("the report " + file + " is no JSON" + expected);
  }
  return record;
}

namespace
{
void
RequireSchema(const json & record, const std::string & file)
{
  if (!record.is_object() || !record.contains("schema") || record["schema"] != ReportSchema)
  {
    const std::string found =
      record.is_object() && record.contains("schema") ? "the schema " + record["schema"].dump() : "no schema";
    throw UnfitReport("the report " + file + " has " + found + "; expected \"" + ReportSchema +
                      "\", a report of estimate-sensor-noise");
  }
}
} // namespace

json
ReadReportRecord(const std::string & file)
{
  json record = ReadJsonFile(file);
  RequireSchema(record, file);
  return record;
}

std::optional<double>
NumberIn(const json & record, const char * name)
{
  const auto found = record.is_object() ? record.find(name) : record.end();
  return record.is_object() && found != record.end() && found->is_number() ? std::optional<double>(found->get<double>())
                                                                           : std::nullopt;
}

} // namespace sensornoise::tools
