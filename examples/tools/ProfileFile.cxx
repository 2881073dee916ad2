// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ProfileFile.h"

#include "sensornoise/ReportText.h"
#include "exports/NoiseProfile.h"
#include "tools/StoredReportFile.h"
#include "tools/TerminalText.h"
#include "itkSensorNoiseProfileFile.h"

#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>

namespace sensornoise::tools
{
namespace
{
/** Deepest nesting of JSON. Tuning files have 5 levels; flattening takes memory of the stack for each. */
constexpr int mostDepth = 64;

nlohmann::json
ParseProfile(const std::string & file, const std::string & text)
{
  const auto limit = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json & value) {
    if (event == nlohmann::json::parse_event_t::key &&
        value.get_ref<const std::string &>().size() > MostProfileNameBytes)
    {
      throw std::runtime_error("the profile " + file + " has a name of more than " +
                               std::to_string(MostProfileNameBytes) +
                               " bytes (--check-profile); expected the JSON file of a camera");
    }
    if (depth > mostDepth)
    {
      throw std::runtime_error("the profile " + file + " has more than " + std::to_string(mostDepth) +
                               " levels of nesting (--check-profile); expected the JSON file of a camera");
    }
    return true;
  };
  nlohmann::json record = nlohmann::json::parse(text, limit, false);
  if (record.is_discarded())
  {
    throw std::runtime_error("the profile " + file +
                             " begins like JSON, but is none (--check-profile); expected a whole file");
  }
  return record;
}
} // namespace

NoiseProfile
ReadProfileFile(const std::string & file)
{
  const std::string bytes = ReadProfileBytes(file);
  return IsJsonProfile(bytes) ? ReadNoiseProfile(ValuesOfJson(file, ParseProfile(file, bytes)))
                              : ReadNoiseProfile(file, bytes);
}

ModelChecks
CheckProfile(const NoiseProfile & profile, const MeasuredStack & measured, const ExportSettings & settings)
{
  const std::string  text = std::visit([](const auto & reports) { return sensornoise::ToJson(reports); }, measured);
  const StoredReport frames = ValuesOfJson("of these frames", nlohmann::json::parse(text));
  const auto         reportReason = [&profile](const std::string & reason) {
    std::cerr << "error: the profile " << profile.file << " cannot be checked: " << ForStandardError(reason) << '\n';
  };
  ModelChecks           checks;
  std::set<std::string> reported; // channels often lack the same
  try
  {
    CameraNoise noise = ReadCameraNoise(frames, settings);
    FillProfileLevels(profile, noise);
    for (const ChannelProfileCheck & channel : CheckStoredFrames(profile, frames, noise))
    {
      checks.push_back(channel.check);
      if (!channel.check && reported.insert(channel.reason).second)
      {
        reportReason(channel.reason);
      }
    }
  }
  catch (const std::exception & error) // the report is written all the same
  {
    reportReason(error.what());
    checks.assign(ReportsOf(measured).size(), std::nullopt);
  }
  return checks;
}

} // namespace sensornoise::tools
