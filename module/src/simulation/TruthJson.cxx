// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"

#include "report/JsonWriter.h"
#include "simulation/FlawsJson.h"
#include "sensornoise/SimulationSettings.h"

#include <array>
#include <optional>
#include <vector>

namespace sensornoise
{
std::string
ToJson(const SimulationTruth & truth, std::size_t width, std::size_t height)
{
  const SimulationSettings & settings = truth.settings;
  const CameraModel &        camera = settings.camera;
  const SceneConditions &    conditions = settings.conditions;
  const double intercept = camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn;
  std::optional<std::vector<double>> phase;
  if (settings.rollingShutterPeriodRows > 0.0)
  {
    phase = truth.series.phase;
  }
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("schema", "itk-sensornoise-truth/1");
    json.Member("frames", settings.frames).Member("width", width).Member("height", height);
    json.Member("bit_depth", settings.bitDepth).Member("seed", static_cast<std::size_t>(settings.seed));
    json.Member("electrons", camera.electrons).Member("gain", camera.gainDnPerElectron);
    json.Member("offset", camera.offsetDn).Member("read_noise", camera.readNoiseDn);
    json.Member("intercept", intercept);
    json.Member("total_intercept", intercept + 1.0 / 12.0); // with quantization noise
    json.Member("clip_low", settings.clipLowDn).Member("clip_high", settings.clipHighDn);
    json.Member("optical_blur", settings.opticalBlurPixels);
    json.Member("rolling_shutter_period", settings.rollingShutterPeriodRows);
    json.Member("prnu_sd", settings.prnuSd).Member("dsnu_sd", settings.dsnuSdDn);
    json.Member("hot_pixel_fraction", settings.hotPixelFraction);
    json.Member("hot_pixel_noise_factor", settings.hotPixelNoiseFactor);
    json.Member("illumination", TextOf(settings.illumination));
    json.Member("flicker_sd", conditions.flickerSd);
    json.Member("vibration_sd", std::array<double, 2>{ conditions.vibrationSdXPixels, conditions.vibrationSdYPixels });
    json.Member("realised_flicker_sd", truth.realisedFlickerSd);
    json.Member("realised_vibration_sd",
                std::array<double, 2>{ truth.realisedVibrationSdXPixels, truth.realisedVibrationSdYPixels });
    json.Member("realised_read_noise", truth.realisedReadNoiseRmsDn);
    json.Member("realised_read_noise_median", truth.realisedReadNoiseMedianDn);
    json.Member("dark", settings.isDark).Member("flaws", settings.flaws);
    json.Member("flicker", truth.normalisedFlicker);
    json.Member("gamma", truth.series.gamma).Member("alpha", truth.series.alpha).Member("beta", truth.series.beta);
    json.Member("phase", phase);
  });
  text += '\n';
  return text;
}

} // namespace sensornoise
