// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/RecordExports.h"

#include "exports/ExportInput.h"
#include "report/JsonWriter.h"

#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** A card of FITS 4.0, section 4.2: the number ends in column 30. */
std::string
FitsCard(const std::string & keyword, double number, const std::string & comment)
{
  constexpr int      decimals = 13; // as many as fit
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
