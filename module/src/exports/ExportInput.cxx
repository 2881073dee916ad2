// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

/** Returns the columns or rows that were measured, which are numbers of 31 bits; 0: the report does not have them. */
std::size_t
SizeAt(const StoredReport & report, const std::string & pointer)
{
  const double size = NumberAt(report, pointer).value_or(0.0);
  return size >= 1.0 && size <= INT32_MAX ? static_cast<std::size_t>(size) : 0;
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
    either(noise.exposureSeconds, "exposure_seconds");
    noise.excessNoiseFactor =
      NumberAt(report, std::string(at) + "/settings/excess_noise_factor").value_or(noise.excessNoiseFactor);
    noise.width = std::max(noise.width, SizeAt(report, std::string(at) + "/width"));
    noise.height = std::max(noise.height, SizeAt(report, std::string(at) + "/height"));
    noise.camera = noise.camera.empty() ? TextAt(report, camera + "name") : noise.camera;
    for (const std::string & pointer : { camera + "bit_depth", std::string(at) + "/bit_depth" })
    {
      const auto bits = NumberAt(report, pointer);
      if (!noise.bitDepth && bits && *bits >= 1.0 && *bits <= 64.0)
      {
        noise.bitDepth = static_cast<unsigned int>(*bits);
      }
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
    throw ExportUseError("the report " + noise.name + " has no channel " + wanted + " (--channel); it has " + found);
  }
}

void
RequirePositiveSetting(const std::optional<double> & value, const char * name)
{
  if (value && !(*value > 0.0 && std::isfinite(*value)))
  {
    throw ExportUseError(std::string("the ") + name + " is " + Text(*value) + "; expected a finite number above 0");
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
      throw ExportUseError("the black or white level is " + Text(*level) + "; expected a finite number");
    }
  }
  if (noise.blackLevelDn && noise.whiteLevelDn && !(*noise.whiteLevelDn > *noise.blackLevelDn))
  {
    const std::string found = "the white level is " + Text(*noise.whiteLevelDn) + " DN and the black level " +
                              Text(*noise.blackLevelDn) + " DN; expected a white level above the black level";
    if (settings.blackLevelDn || settings.whiteLevelDn)
    {
      throw ExportUseError(found);
    }
    throw ExportError(found);
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

namespace
{
const char * const giveDark = "Give estimate-sensor-noise dark frames (--dark) or the offset (--offset).";
const char * const raiseGain =
  "The read noise is not distinguished from 0 or from the quantization noise. Use a higher analogue gain, or record "
  "more frames, with dark frames (--dark) where there are none. A format of the variance line, as ndsafir, does not "
  "need it.";
const char * const readWarnings = "The warnings of the report say why, and what helps.";

std::string
ReportWords(const CameraNoise & noise, const ChannelNoise & channel)
{
  return "the report " + noise.name + (channel.channel == "mono" ? "" : ", channel " + channel.channel + ",");
}

double
RequireIdentified(const CameraNoise &    noise,
                  const ChannelNoise &   channel,
                  const ReportedNumber & quantity,
                  const std::string &    path,
                  const char *           remedy)
{
  if (!quantity.value)
  {
    throw ExportError(ReportWords(noise, channel) + " has no value of " + path + " (it is " + quantity.status +
                      "), which this format needs. " + remedy);
  }
  return *quantity.value;
}

double
RequirePositive(const CameraNoise & noise, const ChannelNoise & channel, double value, const std::string & path)
{
  if (!(value > 0.0 && std::isfinite(value) && std::isfinite(1.0 / value)))
  {
    throw ExportError(ReportWords(noise, channel) + " has a " + path + " of " + Text(value) +
                      "; expected a number above 0, whose reciprocal is finite. Use the report as it was written.");
  }
  return value;
}

/** Returns the standard error of the variance near the dark offset [DN^2], by the errors of read noise and offset;
 * null: one is not known. */
std::optional<double>
DarkVarianceError(const ChannelNoise & channel, double slopeDn)
{
  const auto & noiseError = channel.readNoise.standardError;
  const auto & offsetError = channel.offset.standardError;
  return channel.readNoise.value && noiseError && offsetError
           ? std::optional<double>(std::hypot(2.0 * *channel.readNoise.value * *noiseError, slopeDn * *offsetError))
           : std::nullopt;
}
} // namespace

const ChannelNoise &
OnlyChannel(const CameraNoise & noise, const std::string & format)
{
  if (noise.channels.size() != 1)
  {
    throw ExportError("the report " + noise.name + " has " + std::to_string(noise.channels.size()) + " channels; " +
                      format + " takes the numbers of one. Choose a channel: R, G1, G2 or B (--channel).");
  }
  return noise.channels.front();
}

NoiseModel
ModelOf(const CameraNoise & noise, const ChannelNoise & channel)
{
  NoiseModel model;
  model.varianceSlopeDn = RequireIdentified(noise, channel, channel.varianceSlope, "variance_slope", readWarnings);
  model.totalInterceptDn2 = RequireIdentified(noise, channel, channel.totalIntercept, "total_intercept", readWarnings);
  RequirePositive(noise, channel, model.varianceSlopeDn, "variance_slope");
  return model;
}

NormalisedLine
NormalisedLineOf(const CameraNoise & noise, const ChannelNoise & channel)
{
  const NoiseModel model = ModelOf(noise, channel);
  const double     black = BlackLevelOf(noise);
  const double     range = WhiteLevelOf(noise) - black;
  const double     darkVariance = model.VarianceAt(black);
  if (darkVariance < 0.0)
  {
    const bool hasOffset = channel.offset.value.has_value();
    const auto error = DarkVarianceError(channel, model.varianceSlopeDn);
    throw ExportError(ReportWords(noise, channel) + " has a variance of " +
                      WithSigns((error ? Measured(darkVariance, *error) : Rounded(darkVariance)) + " DN^2") +
                      " at the black level " + Text(black) + " DN; expected 0 or more. The line is 0 at " +
                      Text(-model.totalInterceptDn2 / model.varianceSlopeDn) + " DN" +
                      (hasOffset ? ", and the measured offset is " + Text(*channel.offset.value) + " DN" : "") +
                      ". Give the level of the camera's dark frames as the black level (--black), or measure with "
                      "dark frames (estimate-sensor-noise --dark).");
  }
  const NormalisedLine line{ model.varianceSlopeDn / range, darkVariance / (range * range) };
  if (!(line.scale > 0.0 && std::isfinite(line.scale) && std::isfinite(line.offset)))
  {
    throw ExportError(ReportWords(noise, channel) + " has a variance of " +
                      WithSigns(Text(line.scale) + " x + " + Text(line.offset)) +
                      " at the levels x from 0 (black) to 1 (white); expected finite numbers. Use the report as it was "
                      "written, and levels of the camera (--black, --white).");
  }
  return line;
}

double
GainOf(const CameraNoise & noise, const ChannelNoise & channel)
{
  return RequirePositive(noise, channel, RequireIdentified(noise, channel, channel.gain, "gain", readWarnings), "gain");
}

double
OffsetOf(const CameraNoise & noise, const ChannelNoise & channel)
{
  return RequireIdentified(noise, channel, channel.offset, "offset", giveDark);
}

SensorNumbers
SensorNumbersOf(const CameraNoise & noise, const ChannelNoise & channel)
{
  const double gain = GainOf(noise, channel);
  const char * remedy = channel.readNoise.status == "upper-limit" ? raiseGain : giveDark;
  const double readNoise = RequireIdentified(noise, channel, channel.readNoise, "read_noise", remedy);
  if (!(readNoise >= 0.0 && std::isfinite(readNoise / gain)))
  {
    throw ExportError(ReportWords(noise, channel) + " has a read_noise of " + Text(readNoise) +
                      " DN; expected a finite number of electrons, 0 or more. Use the report as it was written.");
  }
  return { OffsetOf(noise, channel), 1.0 / gain, readNoise / gain };
}

double
BlackLevelOf(const CameraNoise & noise)
{
  if (!noise.blackLevelDn)
  {
    throw ExportError("the report " + noise.name +
                      " has no black level, as its files do not have one. Give the black level in DN (--black).");
  }
  return *noise.blackLevelDn;
}

double
WhiteLevelOf(const CameraNoise & noise)
{
  if (!noise.whiteLevelDn)
  {
    const std::optional<double> clip = noise.channels.front().clipHighDn;
    throw ExportError("the report " + noise.name + " has no white level, as its files do not have one" +
                      (clip ? "; its pixels saturate at " + Text(*clip) + " DN" : "") +
                      ". Give the white level in DN (--white).");
  }
  return *noise.whiteLevelDn;
}

void
RequireIsoSpeeds(const std::vector<CameraNoise> & settings, const std::string & format)
{
  for (const CameraNoise & noise : settings)
  {
    if (!noise.isoSpeed || !(*noise.isoSpeed > 0.0))
    {
      throw ExportError("the report " + noise.name + " has no ISO speed, as its files do not have one; " + format +
                        " needs the ISO speed of each report. Measure with estimate-sensor-noise --sweep and folders "
                        "named by their ISO speeds, as iso100 and iso200.");
    }
    if (noise.channels.size() != settings.front().channels.size())
    {
      throw ExportError("the reports " + settings.front().name + " and " + noise.name + " have " +
                        std::to_string(settings.front().channels.size()) + " and " +
                        std::to_string(noise.channels.size()) + " channels; expected the reports of one camera");
    }
  }
}

NoiseExport
OneFile(const std::string & name, const std::string & bytes, const std::string & note)
{
  NoiseExport made;
  made.files.push_back({ name, bytes });
  made.note = note;
  return made;
}

} // namespace sensornoise
