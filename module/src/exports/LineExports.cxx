// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
const ChannelNoise &
RequireChannel(const CameraNoise & noise, const std::string & name)
{
  for (const ChannelNoise & channel : noise.channels)
  {
    if (channel.channel == name)
    {
      return channel;
    }
  }
  throw ExportError("the report " + noise.name + " has no channel " + name +
                    " of its mosaic; expected R, G1, G2 and B. " +
                    (noise.channels.size() == 1 ? "NoiseProfile takes all channels: leave out the channel (--channel)."
                                                : "Take the report of the whole mosaic."));
}

std::pair<double, double>
ProfilePair(const CameraNoise & noise, const ChannelNoise & channel)
{
  const NormalisedLine line = NormalisedLineOf(noise, channel);
  return { line.scale, line.offset };
}
} // namespace

std::vector<std::pair<double, double>>
NoiseProfileOf(const CameraNoise & noise)
{
  if (noise.channels.size() == 1 && noise.channels.front().channel == "mono")
  {
    return { ProfilePair(noise, noise.channels.front()) };
  }
  const auto red = ProfilePair(noise, RequireChannel(noise, "R"));
  const auto first = ProfilePair(noise, RequireChannel(noise, "G1"));
  const auto second = ProfilePair(noise, RequireChannel(noise, "G2"));
  const auto blue = ProfilePair(noise, RequireChannel(noise, "B"));
  // Half of the green pixels have the noise of G1, half have the noise of G2.
  return { red, { 0.5 * (first.first + second.first), 0.5 * (first.second + second.second) }, blue };
}

NoiseExport
ExportDng(const CameraNoise & noise)
{
  std::string text;
  for (const auto & [scale, offset] : NoiseProfileOf(noise))
  {
    text += (text.empty() ? "" : " ") + ShortestText(scale) + ' ' + ShortestText(offset);
  }
  return OneFile("noise_profile.txt", text + '\n');
}

NoiseExport
ExportNdsafir(const CameraNoise & noise)
{
  std::vector<double>      gains;
  std::vector<double>      offsets;
  std::vector<std::string> channels;
  for (const ChannelNoise & channel : noise.channels)
  {
    const NoiseModel model = ModelOf(noise, channel);
    gains.push_back(model.varianceSlopeDn);
    offsets.push_back(model.totalInterceptDn2);
    channels.push_back(channel.channel);
  }
  std::string text;
  JsonWriter  json(text);
  json.Object([&] { json.Member("channels", channels).Member("gains", gains).Member("offsets", offsets); });
  return OneFile("ndsafir.json", text + '\n');
}

NoiseExport
ExportAnscombeTransform(const CameraNoise & noise)
{
  const NoiseModel model = ModelOf(noise, OnlyChannel(noise, "anscombe-transform"));
  const double     zero = -model.totalInterceptDn2 / model.varianceSlopeDn;
  const double     rounded = std::round(zero);
  std::string      text;
  JsonWriter       json(text);
  json.Object([&] { json.Member("conversion_gain", model.varianceSlopeDn).Member("zero_level", rounded); });
  return OneFile("anscombe_transform.json",
                 text + '\n',
                 "The zero level is rounded from " + Text(zero) + " DN: all variances are " +
                   WithSigns(Rounded(model.varianceSlopeDn * (zero - rounded)) + " DN^2") + " too large.");
}

NoiseExport
ExportDeepinv(const CameraNoise & noise)
{
  const NormalisedLine line = NormalisedLineOf(noise, OnlyChannel(noise, "deepinv"));
  std::string          text;
  JsonWriter           json(text);
  json.Object([&] {
    json.Member("gain", line.scale).Member("sigma", std::sqrt(line.offset));
    json.Member("black_level", BlackLevelOf(noise)).Member("white_level", WhiteLevelOf(noise));
  });
  return OneFile(
    "deepinv.json", text + '\n', "The levels of the images are (x - black_level) / (white_level - black_level).");
}

} // namespace sensornoise
