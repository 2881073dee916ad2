// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/NoiseModelFile.h"

#include "sensornoise/report/ReportJson.h"

#include <algorithm>
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

json
ReadJson(const std::string & file)
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
  if (record.contains("channels"))
  {
    throw UnfitReport("the report " + file +
                      " has several channels; expected the report of one, an item of its \"channels\"");
  }
}

/** A number, or nothing where there is null, another type, or no such member. */
std::optional<double>
NumberIn(const json & record, const char * name)
{
  const auto found = record.is_object() ? record.find(name) : record.end();
  return record.is_object() && found != record.end() && found->is_number() ? std::optional<double>(found->get<double>())
                                                                           : std::nullopt;
}

double
ValueIn(const json & record, const char * name, const std::string & file)
{
  const json quantity = record.contains(name) ? record[name] : json();
  if (const auto value = NumberIn(quantity, "value"))
  {
    return *value;
  }
  const std::string status = quantity.is_object() && quantity.contains("status") && quantity["status"].is_string()
                               ? quantity["status"].get<std::string>()
                               : "missing";
  throw UnfitReport("the report " + file + " has no value of " + name + " (it is " + status +
                    "); expected a report that has variance_slope and total_intercept");
}

void
ReadLevels(const json & record, NoiseModelFile & file)
{
  file.codeStepDn = NumberIn(record, "quantisation_step");
  file.clipLowDn = NumberIn(record, "clip_low");
  file.clipHighDn = NumberIn(record, "clip_high");
  const auto scatter = record.find("scatter");
  if (scatter == record.end() || !scatter->is_object() || !scatter->contains("mean"))
  {
    return;
  }
  for (const json & mean : (*scatter)["mean"])
  {
    if (mean.is_number())
    {
      const auto level = mean.get<double>();
      file.lowestDn = file.lowestDn ? std::min(*file.lowestDn, level) : level;
      file.highestDn = file.highestDn ? std::max(*file.highestDn, level) : level;
    }
  }
}
} // namespace

NoiseModelFile
ReadNoiseModel(const std::string & file)
{
  const json record = ReadJson(file);
  RequireSchema(record, file);
  NoiseModelFile found;
  found.name = file;
  found.model = { ValueIn(record, "variance_slope", file), ValueIn(record, "total_intercept", file) };
  try
  {
    found.model.Validate();
  }
  catch (const std::invalid_argument & error)
  {
    throw UnfitReport("the report " + file + " does not serve: " + error.what());
  }
  ReadLevels(record, found);
  return found;
}

} // namespace sensornoise::tools
