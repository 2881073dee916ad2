// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace sensornoise
{
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
