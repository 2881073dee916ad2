// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/SensorExports.h"

#include "exports/ExportInput.h"
#include "report/JsonWriter.h"

#include <string>

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

/** Offset and electrons per DN, of programs that do not ask for the read noise. */
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

} // namespace sensornoise
