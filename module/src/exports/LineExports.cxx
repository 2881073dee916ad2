// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "files/FileBytes.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
                   Rounded(model.varianceSlopeDn * (zero - rounded)) + " DN^2 too large.");
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

namespace
{
// TIFF 6.0, section 2, and DNG 1.7, tag NoiseProfile. The new directory and the new values stand at the end of the
// file: no byte that another tag points to moves.

constexpr std::size_t   headBytes = 8;
constexpr std::size_t   entryBytes = 12;
constexpr std::uint64_t noiseProfileTag = 51041;
constexpr std::uint64_t doubleType = 12;

std::uint64_t
NumberAt(const std::string & file, std::size_t offset, std::size_t bytes, bool isBigEndian)
{
  if (offset > file.size() || file.size() - offset < bytes)
  {
    throw ExportError("the TIFF file ends at byte " + std::to_string(file.size()) +
                      ", before the end of its first directory; expected a whole file");
  }
  return NumberInBytes(reinterpret_cast<const unsigned char *>(file.data()) + offset, bytes, isBigEndian);
}

bool
IsBigEndianTiff(const std::string & file)
{
  const std::string head = file.substr(0, 4);
  if (head == std::string("MM\0*", 4))
  {
    return true;
  }
  if (head != std::string("II*\0", 4))
  {
    throw ExportError("the file is no classic TIFF; expected a DNG file, which begins with II*\\0 or MM\\0*");
  }
  return false;
}
} // namespace

std::string
WithNoiseProfile(const std::string & file, const std::vector<std::pair<double, double>> & profile)
{
  const bool isBigEndian = IsBigEndianTiff(file);
  const auto directory = static_cast<std::size_t>(NumberAt(file, 4, 4, isBigEndian));
  const auto count = static_cast<std::size_t>(NumberAt(file, directory, 2, isBigEndian));
  const auto bytesOf = [&](std::uint64_t number, std::size_t bytes) {
    return BytesOfNumber(number, bytes, isBigEndian);
  };
  const auto  next = NumberAt(file, directory + 2 + count * entryBytes, 4, isBigEndian);
  std::string copy = file + std::string(file.size() % 2, '\0'); // values begin at even offsets

  const std::string entry =
    bytesOf(noiseProfileTag, 2) + bytesOf(doubleType, 2) + bytesOf(2 * profile.size(), 4) + bytesOf(copy.size(), 4);
  for (const auto & [scale, offset] : profile)
  {
    copy += BytesOfReal(scale, isBigEndian) + BytesOfReal(offset, isBigEndian);
  }
  std::vector<std::pair<std::uint64_t, std::string>> entries{ { noiseProfileTag, entry } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t at = directory + 2 + i * entryBytes;
    const auto        tag = NumberAt(file, at, 2, isBigEndian);
    if (tag != noiseProfileTag)
    {
      entries.emplace_back(tag, file.substr(at, entryBytes));
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto & a, const auto & b) { return a.first < b.first; });

  const std::size_t begin = copy.size();
  copy += bytesOf(entries.size(), 2);
  for (const auto & [tag, bytes] : entries)
  {
    copy += bytes;
  }
  copy += bytesOf(next, 4);
  if (copy.size() > std::numeric_limits<std::uint32_t>::max() ||
      entries.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw ExportError("the file has " + std::to_string(file.size()) + " bytes and " + std::to_string(count) +
                      " tags; a TIFF file has at most 4 GiB and 65535 tags");
  }
  copy.replace(4, headBytes - 4, bytesOf(begin, 4));
  return copy;
}

std::vector<std::pair<double, double>>
NoiseProfileIn(const std::string & file)
{
  constexpr std::size_t numberBytes = sizeof(double);
  constexpr std::size_t mostPlanes = 4;
  const bool            isBigEndian = IsBigEndianTiff(file);
  const auto            directory = static_cast<std::size_t>(NumberAt(file, 4, 4, isBigEndian));
  const auto            entries = static_cast<std::size_t>(NumberAt(file, directory, 2, isBigEndian));
  NumberAt(file, directory + 2 + entries * entryBytes, 4, isBigEndian); // throws if the directory is not whole
  for (std::size_t at = directory + 2; at < directory + 2 + entries * entryBytes; at += entryBytes)
  {
    if (NumberAt(file, at, 2, isBigEndian) != noiseProfileTag)
    {
      continue;
    }
    const auto type = NumberAt(file, at + 2, 2, isBigEndian);
    const auto count = NumberAt(file, at + 4, 4, isBigEndian);
    if (type != doubleType || count < 2 || count % 2 != 0 || count > 2 * mostPlanes)
    {
      throw ExportError("the tag NoiseProfile has " + std::to_string(count) + " numbers of TIFF's type " +
                        std::to_string(type) + "; expected pairs of DOUBLE (12), at most " +
                        std::to_string(mostPlanes));
    }
    const auto values = static_cast<std::size_t>(NumberAt(file, at + 8, 4, isBigEndian));
    const auto number = [&](std::size_t i) {
      return RealOfBits(NumberAt(file, values + i * numberBytes, numberBytes, isBigEndian));
    };
    std::vector<std::pair<double, double>> profile;
    for (std::size_t i = 0; i < count; i += 2)
    {
      profile.emplace_back(number(i), number(i + 1));
    }
    return profile;
  }
  throw ExportError("the file has no tag NoiseProfile (51041) in its first directory, where DNG files have it");
}

} // namespace sensornoise
