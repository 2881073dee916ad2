// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/NoiseModelFile.h"

#include "tools/ReportFile.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
using nlohmann::json;

void
RequireOneChannel(const json & record, const std::string & file)
{
  if (record.contains("channels"))
  {
    throw UnfitReport("the report " + file +
                      " has several channels; expected the report of one, an item of its \"channels\"");
  }
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
  file.quantisationStepDn = NumberIn(record, "quantisation_step");
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
  const json record = ReadReportRecord(file);
  RequireOneChannel(record, file);
  NoiseModelFile found;
  found.name = file;
  found.model = { ValueIn(record, "variance_slope", file), ValueIn(record, "total_intercept", file) };
  try
  {
    found.model.Validate();
  }
  catch (const std::invalid_argument & error)
  {
    throw UnfitReport("the report " + file + " cannot be used: " + error.what());
  }
  ReadLevels(record, found);
  return found;
}

} // namespace sensornoise::tools
