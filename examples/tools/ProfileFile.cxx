// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ProfileFile.h"

#include "exports/ProfileCheck.h"
#include "sensornoise/ReportText.h"
#include "tools/StoredReportFile.h"
#include "itkSensorNoiseFrameFiles.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <variant>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Largest file: a TIFF file has offsets of 32 bits. */
constexpr std::uintmax_t mostBytes = std::uintmax_t{ 1 } << 32U;
/** Deepest nesting of JSON. Tuning files have 5 levels; flattening takes memory of the stack for each. */
constexpr int mostDepth = 64;

std::string
ReadProfileBytes(const std::string & file)
{
  std::error_code ignored;
  std::ifstream   stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, ignored) || !stream)
  {
    throw std::runtime_error("the profile " + file +
                             " cannot be read (--check-profile); expected a DNG file, a JSON file or another profile");
  }
  const auto size = std::filesystem::file_size(file, ignored);
  if (size > mostBytes)
  {
    throw std::runtime_error("the profile " + file + " has " + std::to_string(size) +
                             " bytes (--check-profile); expected a DNG file or another profile of at most 4 GiB");
  }
  return { std::istreambuf_iterator<char>(stream), {} };
}

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

/** Takes the black and the white level of a DNG file with a profile, where neither an option nor the frames give them.
 */
void
FillLevels(const NoiseProfile & profile, CameraNoise & noise)
{
  if (profile.format != "dng" || (noise.blackLevelDn && noise.whiteLevelDn))
  {
    return;
  }
  try
  {
    const CameraSettings camera = OpenFrames({ profile.file }, {}, {}, {}).camera;
    const auto           fill = [](std::optional<double> & level, double recorded) {
      level = level || !std::isfinite(recorded) ? level : std::optional<double>(recorded);
    };
    fill(noise.blackLevelDn, camera.blackLevelDn);
    fill(noise.whiteLevelDn, camera.whiteLevelDn);
  }
  catch (const std::exception &) // the numbers as text, or a copy without pixels: the levels are asked for
  {
    return;
  }
}
} // namespace

NoiseProfile
ReadProfileFile(const std::string & file)
{
  std::string bytes = ReadProfileBytes(file);
  if (bytes.rfind("\xef\xbb\xbf", 0) == 0) // the byte order mark of UTF-8
  {
    bytes.erase(0, 3);
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (bytes[first] == '{' || bytes[first] == '[')
           ? ReadNoiseProfile(ValuesOfJson(file, ParseProfile(file, bytes)))
           : ReadNoiseProfile(file, bytes);
}

ModelChecks
CheckProfile(const NoiseProfile & profile, const MeasuredStack & measured, const ExportSettings & settings)
{
  const std::vector<const Report *> frames = ReportsOf(measured);
  const std::string text = std::visit([](const auto & reports) { return sensornoise::ToJson(reports); }, measured);
  ModelChecks       checks(frames.size());
  CameraNoise       noise;
  try
  {
    noise = ReadCameraNoise(ValuesOfJson("of these frames", nlohmann::json::parse(text)), settings);
    FillLevels(profile, noise);
  }
  catch (const std::exception & error) // the report is written all the same
  {
    std::cerr << "error: the profile " << profile.file << " cannot be checked: " << error.what() << '\n';
    return checks;
  }
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    CameraNoise burst = noise;
    burst.channels = { noise.channels.at(k) };
    try
    {
      checks[k] = CheckNoiseProfile(profile, *frames[k], burst);
    }
    catch (const ExportError & error)
    {
      std::cerr << "error: the profile " << profile.file << " cannot be checked: " << error.what() << '\n';
    }
  }
  return checks;
}

} // namespace sensornoise::tools
