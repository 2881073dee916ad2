// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/AndroidExport.h"

#include "base/Text.h"
#include "exports/ExportInput.h"
#include "exports/RelativeFit.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** The model of one channel. */
struct AndroidChannel
{
  std::array<double, 2> scale{};  // A, B
  std::array<double, 2> offset{}; // C, D
  double                misfit{ 0.0 };
};

double
DigitalGainOf(const CameraNoise & noise)
{
  return noise.maxAnalogueIso ? std::max(1.0, *noise.isoSpeed / *noise.maxAnalogueIso) : 1.0;
}

AndroidChannel
FitAndroidChannel(const std::vector<CameraNoise> & settings, std::size_t channel)
{
  std::vector<TwoTerms> scales;
  std::vector<TwoTerms> offsets;
  for (const CameraNoise & noise : settings)
  {
    const NormalisedLine line = NormalisedLineOf(noise, noise.channels[channel]);
    const double         iso = *noise.isoSpeed;
    const double         digital = DigitalGainOf(noise);
    scales.push_back({ iso, 1.0, line.scale });
    offsets.push_back({ iso * iso, digital * digital, line.offset });
  }
  AndroidChannel model{ SolveRelative(scales, false), SolveRelative(offsets, true) };
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    for (const double level : { 0.0, 0.1, 1.0 }) // of the range: dark, dim and bright
    {
      const double fitted = (scales[i].first * model.scale[0] + model.scale[1]) * level +
                            offsets[i].first * model.offset[0] + offsets[i].second * model.offset[1];
      const double measured = scales[i].wanted * level + offsets[i].wanted;
      model.misfit = measured > 0.0 ? std::max(model.misfit, std::abs(fitted / measured - 1.0)) : model.misfit;
    }
  }
  return model;
}

void
RequireAlike(const std::vector<CameraNoise> & settings)
{
  std::set<double> speeds;
  for (const CameraNoise & noise : settings)
  {
    if (!noise.isoSpeed || !(*noise.isoSpeed > 0.0))
    {
      throw ExportError("the report " + noise.name +
                        " has no ISO speed, as its files do not have one; android needs the ISO speed of each report");
    }
    if (noise.channels.size() != settings.front().channels.size())
    {
      throw ExportError("the reports " + settings.front().name + " and " + noise.name + " have " +
                        std::to_string(settings.front().channels.size()) + " and " +
                        std::to_string(noise.channels.size()) + " channels; expected the reports of one camera");
    }
    speeds.insert(*noise.isoSpeed);
  }
  if (speeds.size() < 2)
  {
    throw ExportError("all reports have the ISO speed " + Text(*speeds.begin()) +
                      "; expected 2 or more different ISO speeds. Measure a burst at another one.");
  }
}
} // namespace

NoiseExport
ExportAndroid(const std::vector<CameraNoise> & settings)
{
  RequireAlike(settings);
  std::vector<std::string>           names;
  std::array<std::vector<double>, 4> coefficients;
  double                             misfit = 0.0;
  for (std::size_t channel = 0; channel < settings.front().channels.size(); ++channel)
  {
    const std::string    name = settings.front().channels[channel].channel;
    const AndroidChannel model = FitAndroidChannel(settings, channel);
    names.push_back(name == "G1" ? "Gr" : name == "G2" ? "Gb" : name);
    coefficients[0].push_back(model.scale[0]);
    coefficients[1].push_back(model.scale[1]);
    coefficients[2].push_back(model.offset[0]);
    coefficients[3].push_back(model.offset[1]);
    misfit = std::max(misfit, model.misfit);
  }
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("channels", names);
    json.Member("noise_model_A", coefficients[0]).Member("noise_model_B", coefficients[1]);
    json.Member("noise_model_C", coefficients[2]).Member("noise_model_D", coefficients[3]);
    json.Member("max_analog_iso", settings.front().maxAnalogueIso);
  });
  return OneFile("android_noise_model.json",
                 text + '\n',
                 "The fitted variance differs from the measured variance by " + Percent(misfit) + " at most.");
}

} // namespace sensornoise
