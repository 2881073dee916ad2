// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"
#include "sensornoise/NoiseExport.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace sensornoise
{
namespace
{
std::optional<double>
NumberAt(const StoredReport & report, const std::string & pointer)
{
  const auto found = report.numbers.find(pointer);
  return found == report.numbers.end() ? std::nullopt : std::optional<double>(found->second);
}

std::string
TextAt(const StoredReport & report, const std::string & pointer)
{
  const auto found = report.texts.find(pointer);
  return found == report.texts.end() ? "" : found->second;
}

ReportedNumber
QuantityAt(const StoredReport & report, const std::string & pointer)
{
  ReportedNumber quantity;
  quantity.value = NumberAt(report, pointer + "/value");
  quantity.standardError = NumberAt(report, pointer + "/standard_error");
  const std::string status = TextAt(report, pointer + "/status");
  quantity.status = status.empty() ? "missing" : status;
  return quantity;
}

void
ReadLevelRange(const StoredReport & report, const std::string & at, ChannelNoise & channel)
{
  const std::string list = at + "/scatter/mean/";
  for (auto item = report.numbers.lower_bound(list);
       item != report.numbers.end() && item->first.compare(0, list.size(), list) == 0;
       ++item)
  {
    channel.lowestDn = std::min(channel.lowestDn.value_or(item->second), item->second);
    channel.highestDn = std::max(channel.highestDn.value_or(item->second), item->second);
  }
}

ChannelNoise
ChannelAt(const StoredReport & report, const std::string & at)
{
  ChannelNoise channel;
  const auto   name = TextAt(report, at + "/channel");
  channel.channel = name.empty() ? "mono" : name;
  channel.varianceSlope = QuantityAt(report, at + "/variance_slope");
  channel.totalIntercept = QuantityAt(report, at + "/total_intercept");
  channel.gain = QuantityAt(report, at + "/gain");
  channel.offset = QuantityAt(report, at + "/offset");
  channel.readNoise = QuantityAt(report, at + "/read_noise");
  channel.readNoiseElectronsError = NumberAt(report, at + "/read_noise_electrons/standard_error");
  channel.clipHighDn = NumberAt(report, at + "/clip_high");
  ReadLevelRange(report, at, channel);
  return channel;
}

void
ReadCameraSettings(const StoredReport & report, CameraNoise & noise)
{
  for (const char * at : { "", "/channels/0" })
  {
    const std::string camera = std::string(at) + "/camera/";
    const auto        either = [&](std::optional<double> & value, const char * member) {
      value = value ? value : NumberAt(report, camera + member);
    };
    either(noise.blackLevelDn, "black_level");
    either(noise.whiteLevelDn, "white_level");
    either(noise.isoSpeed, "iso_speed");
    noise.camera = noise.camera.empty() ? TextAt(report, camera + "name") : noise.camera;
    for (const std::string & pointer : { camera + "bit_depth", std::string(at) + "/bit_depth" })
    {
      const auto bits = NumberAt(report, pointer);
      noise.bitDepth = noise.bitDepth || !bits ? noise.bitDepth : static_cast<unsigned int>(*bits);
    }
  }
}

void
ChooseChannel(const std::string & wanted, CameraNoise & noise)
{
  if (wanted.empty())
  {
    return;
  }
  std::string found;
  for (const ChannelNoise & channel : noise.channels)
  {
    found += (found.empty() ? "" : ", ") + channel.channel;
  }
  auto & channels = noise.channels;
  channels.erase(std::remove_if(channels.begin(),
                                channels.end(),
                                [&](const ChannelNoise & channel) { return channel.channel != wanted; }),
                 channels.end());
  if (channels.empty())
  {
    throw ExportError("the report " + noise.name + " has no channel " + wanted + "; it has " + found);
  }
}

void
RequirePositiveSetting(const std::optional<double> & value, const char * name)
{
  if (value && !(*value > 0.0 && std::isfinite(*value)))
  {
    throw ExportError(std::string("the ") + name + " is " + Text(*value) + "; expected a finite number above 0");
  }
}

void
ApplySettings(const ExportSettings & settings, CameraNoise & noise)
{
  noise.blackLevelDn = settings.blackLevelDn ? settings.blackLevelDn : noise.blackLevelDn;
  noise.whiteLevelDn = settings.whiteLevelDn ? settings.whiteLevelDn : noise.whiteLevelDn;
  noise.analogueGain = settings.analogueGain;
  noise.maxAnalogueIso = settings.maxAnalogueIso;
  RequirePositiveSetting(settings.analogueGain, "analogue gain");
  RequirePositiveSetting(settings.maxAnalogueIso, "highest analogue ISO");
  for (const auto & level : { noise.blackLevelDn, noise.whiteLevelDn })
  {
    if (level && !std::isfinite(*level))
    {
      throw ExportError("the black or white level is " + Text(*level) + "; expected a finite number");
    }
  }
  if (noise.blackLevelDn && noise.whiteLevelDn && !(*noise.whiteLevelDn > *noise.blackLevelDn))
  {
    throw ExportError("the white level is " + Text(*noise.whiteLevelDn) + " DN and the black level " +
                      Text(*noise.blackLevelDn) + " DN; expected a white level above the black level");
  }
}
} // namespace

CameraNoise
ReadCameraNoise(const StoredReport & report, const ExportSettings & settings)
{
  const std::string schema = TextAt(report, "/schema");
  if (schema != ReportSchema)
  {
    throw ExportError("the report " + report.name + " has " +
                      (schema.empty() ? "no schema" : "the schema \"" + schema + "\"") + "; expected \"" +
                      ReportSchema + "\", a report of estimate-sensor-noise");
  }
  CameraNoise noise;
  noise.name = report.name;
  const std::string list = "/channels/";
  for (std::size_t i = 0; !TextAt(report, list + std::to_string(i) + "/channel").empty(); ++i)
  {
    noise.channels.push_back(ChannelAt(report, list + std::to_string(i)));
  }
  if (noise.channels.empty())
  {
    noise.channels.push_back(ChannelAt(report, ""));
  }
  ReadCameraSettings(report, noise);
  ChooseChannel(settings.channel, noise);
  ApplySettings(settings, noise);
  return noise;
}

} // namespace sensornoise
