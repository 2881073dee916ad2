// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Formats that hold measured numbers as they are: first the line of the variance, then the numbers of the sensor.

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

namespace
{
/** The name of the camera as a string of YAML, which has JSON's strings. */
std::string
CameraKey(const CameraNoise & noise)
{
  std::string text;
  JsonWriter(text).Write(noise.camera.empty() ? std::string("camera") : noise.camera);
  return text;
}

/** Returns offset and electrons per DN, for programs that do not need the read noise. */
SensorNumbers
OffsetAndGain(const CameraNoise & noise, const std::string & format)
{
  const ChannelNoise & channel = OnlyChannel(noise, format);
  return { OffsetOf(noise, channel), 1.0 / GainOf(noise, channel), 0.0 };
}
} // namespace

NoiseExport
ExportPyme(const CameraNoise & noise)
{
  const SensorNumbers sensor = SensorNumbersOf(noise, OnlyChannel(noise, "pyme"));
  const std::string   indent(8, ' ');
  const std::string   text = CameraKey(noise) + ":\n    noise_properties:\n      fixed:\n" + indent +
                           "ADOffset: " + ShortestText(sensor.offsetDn) + '\n' + indent +
                           "ElectronsPerCount: " + ShortestText(sensor.electronsPerDn) + '\n' + indent +
                           "ReadNoise: " + ShortestText(sensor.readNoiseElectrons) + '\n' + indent +
                           "SaturationThreshold: " + ShortestText(WhiteLevelOf(noise)) + '\n';
  return OneFile(
    "pyme_camera.yaml",
    text,
    "Replace the first line by the serial number of the camera, and \"fixed\" by the name of its gain mode.");
}

NoiseExport
ExportPicasso(const CameraNoise & noise)
{
  const SensorNumbers sensor = OffsetAndGain(noise, "picasso");
  const std::string   text = "Cameras:\n  " + CameraKey(noise) +
                           ":\n    Sensor: sCMOS\n    Baseline: " + ShortestText(sensor.offsetDn) +
                           "\n    Sensitivity: " + ShortestText(sensor.electronsPerDn) + '\n';
  return OneFile("picasso_config.yaml", text);
}

NoiseExport
ExportSmap(const CameraNoise & noise)
{
  const SensorNumbers sensor = OffsetAndGain(noise, "smap");
  std::string         text;
  JsonWriter          json(text);
  json.Object([&] {
    json.Member("offset", sensor.offsetDn).Member("conversion", sensor.electronsPerDn);
    json.Member("emgain", 1).Member("EMon", false);
  });
  return OneFile("smap_camera.json", text + '\n');
}

NoiseExport
ExportDecode(const CameraNoise & noise)
{
  const SensorNumbers sensor = SensorNumbersOf(noise, OnlyChannel(noise, "decode"));
  const std::string   text = "Camera:\n  baseline: " + ShortestText(sensor.offsetDn) +
                           "\n  convert2photons: true\n  e_per_adu: " + ShortestText(sensor.electronsPerDn) +
                           "\n  em_gain:\n  qe: 1.0\n  read_sigma: " + ShortestText(sensor.readNoiseElectrons) +
                           "\n  spur_noise: 0.0\n";
  return OneFile("decode_camera.yaml", text, "With qe 1.0, DECODE's photons are photoelectrons.");
}

NoiseExport
ExportThunderstorm(const CameraNoise & noise)
{
  const SensorNumbers sensor = OffsetAndGain(noise, "thunderstorm");
  const std::string   text = "run(\"Camera setup\", \"offset=" + ShortestText(sensor.offsetDn) +
                           " isemgain=false photons2adu=" + ShortestText(sensor.electronsPerDn) + "\");\n";
  return OneFile("thunderstorm_camera.ijm", text, "The macro leaves the pixel size as it is set in ThunderSTORM.");
}

namespace
{
/** A card of FITS 4.0, section 4.2: the number ends in column 30. */
std::string
FitsCard(const std::string & keyword, double number, const std::string & comment)
{
  constexpr int      decimals = 13; // the largest number that fits into the columns of the card
  std::ostringstream card;
  card << std::left << std::setw(8) << keyword << "= " << std::right << std::setw(20) << std::uppercase
       << std::scientific << std::setprecision(decimals) << number << " / " << comment;
  std::string text = card.str();
  text.resize(80, ' ');
  return text;
}

void
WriteAstropy(JsonWriter & json, const char * name, double value, const char * unit)
{
  json.ObjectMember(name, [&] { json.Member("value", value).Member("unit", unit); });
}

std::string
EmvaAttribute(const std::string & name, const std::string & symbol, const std::string & unit, double value)
{
  return "    <" + name + ">\n      <Symbol>" + symbol + "</Symbol>\n      <Unit>" + unit + "</Unit>\n      <Value>" +
         ShortestText(value) + "</Value>\n    </" + name + ">\n";
}

/** One number of each amplifier. */
struct AmplifierValues
{
  const char *                       name;
  std::vector<std::optional<double>> values;
};
} // namespace

NoiseExport
ExportFits(const CameraNoise & noise)
{
  const SensorNumbers sensor = SensorNumbersOf(noise, OnlyChannel(noise, "fits"));
  return OneFile("noise_cards.txt",
                 FitsCard("EGAIN", sensor.electronsPerDn, "[electron/adu] electrons per ADU") + '\n' +
                   FitsCard("RDNOISE", sensor.readNoiseElectrons, "[electron] read noise, rms") + '\n');
}

NoiseExport
ExportCcdproc(const CameraNoise & noise)
{
  const SensorNumbers sensor = SensorNumbersOf(noise, OnlyChannel(noise, "ccdproc"));
  std::string         text;
  JsonWriter          json(text);
  json.Object([&] {
    WriteAstropy(json, "gain", sensor.electronsPerDn, "electron / adu");
    WriteAstropy(json, "readnoise", sensor.readNoiseElectrons, "electron");
    WriteAstropy(json, "offset", sensor.offsetDn, "adu");
  });
  return OneFile("ccdproc.json", text + '\n', "Subtract the offset from the frames before ccdproc.create_deviation().");
}

NoiseExport
ExportLsst(const CameraNoise & noise)
{
  AmplifierValues          gain{ "gain", {} };
  AmplifierValues          gainError{ "gainErr", {} };
  AmplifierValues          readNoise{ "noise", {} };
  AmplifierValues          readNoiseError{ "noiseErr", {} };
  std::vector<std::string> names;
  for (const ChannelNoise & channel : noise.channels)
  {
    const SensorNumbers sensor = SensorNumbersOf(noise, channel);
    const auto          error = channel.gain.standardError;
    names.push_back(channel.channel);
    gain.values.emplace_back(sensor.electronsPerDn);
    gainError.values.push_back(error ? std::optional<double>(*error * sensor.electronsPerDn * sensor.electronsPerDn)
                                     : std::nullopt);
    readNoise.values.emplace_back(sensor.readNoiseElectrons);
    readNoiseError.values.push_back(channel.readNoiseElectronsError);
  }
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("ampNames", names);
    for (const AmplifierValues & each : { gain, gainError, readNoise, readNoiseError })
    {
      json.ObjectMember(each.name, [&] {
        for (std::size_t i = 0; i < names.size(); ++i)
        {
          json.Member(names[i].c_str(), each.values[i]);
        }
      });
    }
  });
  return OneFile("lsst_ptc.json", text + '\n', "Replace the names of the amplifiers by the detector's.");
}

NoiseExport
ExportEmva1288(const CameraNoise & noise)
{
  const ChannelNoise & channel = OnlyChannel(noise, "emva1288");
  const SensorNumbers  sensor = SensorNumbersOf(noise, channel);
  return OneFile("emva1288.xml",
                 "<results>\n  <sensitivity>\n" + EmvaAttribute("K", "K", "DN/e^-", GainOf(noise, channel)) +
                   EmvaAttribute("inverse_K", "1/K", "e^-/DN", sensor.electronsPerDn) +
                   EmvaAttribute("sigma_d", "sigma_d", "e^-", sensor.readNoiseElectrons) +
                   "  </sensitivity>\n</results>\n");
}

} // namespace sensornoise
