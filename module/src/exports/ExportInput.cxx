// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportInput.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <optional>
#include <string>

namespace sensornoise
{
namespace
{
const char * const giveDark = "Give estimate-sensor-noise dark frames (--dark) or the offset (--offset).";
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
  if (!(value > 0.0))
  {
    throw ExportError(ReportWords(noise, channel) + " has a " + path + " of " + Text(value) +
                      "; expected a number above 0");
  }
  return value;
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
    throw ExportError(ReportWords(noise, channel) + " has a variance of " + Rounded(darkVariance) +
                      " DN^2 at the black level " + Text(black) + " DN; expected 0 or more. The line is 0 at " +
                      Text(-model.totalInterceptDn2 / model.varianceSlopeDn) + " DN" +
                      (hasOffset ? ", and the measured offset is " + Text(*channel.offset.value) + " DN" : "") +
                      ". Give the level of the camera's dark frames as the black level (--black).");
  }
  return { model.varianceSlopeDn / range, darkVariance / (range * range) };
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
  const double readNoise = RequireIdentified(noise, channel, channel.readNoise, "read_noise", giveDark);
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

std::string
ShortestText(double number)
{
  std::string text;
  JsonWriter(text).Write(number);
  return text;
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
