// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorLines.h"
#include "studies/RealSensorSituations.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using Settings = std::vector<RealSensorSetting>;
using Kinds = std::vector<std::string>;

const Kinds White{ "white" };
const Kinds Filtered{ "filtered" };
const Kinds Enlarged{ "enlarged" };
const Kinds NotWhite{ "not-linear", "filtered" };

/** Returns the settings of AppendEverywhere() for each of \a strengths. \a apply sets the strength in the flaws. */
template <typename TStrength, typename TApply>
Settings
MakeStrengths(const std::vector<TStrength> & strengths, const std::string & unit, const Kinds & kinds, TApply apply)
{
  Settings all;
  for (const TStrength & strength : strengths)
  {
    AppendEverywhere(all, ShortText(strength) + unit, kinds, [&](RealSensorSetting & setting) {
      apply(setting.settings.flaws, strength);
    });
  }
  return all;
}

/** Returns settings with white noise, row noise, column noise, banding, and illumination that varies over the frame. */
Settings
MakePlainSettings()
{
  Settings all;
  AppendEverywhere(all, "plain", White, [](RealSensorSetting &) {});
  for (const double fraction : { 0.2, 0.5, 1.0 })
  {
    AppendEverywhere(all, "row noise " + ShortText(fraction) + " sigma", White, [=](RealSensorSetting & setting) {
      setting.settings.flaws.lineNoise.rowNoiseSdDn = fraction * setting.settings.camera.readNoiseDn;
    });
    AppendEverywhere(all, "column noise " + ShortText(fraction) + " sigma", White, [=](RealSensorSetting & setting) {
      setting.settings.flaws.lineNoise.columnNoiseSdDn = fraction * setting.settings.camera.readNoiseDn;
    });
  }
  AppendEverywhere(all, "banding 0.5 sigma", White, [](RealSensorSetting & setting) {
    setting.settings.flaws.lineNoise.bandingAmplitudeDn = 0.5 * setting.settings.camera.readNoiseDn;
    setting.settings.flaws.lineNoise.bandingPeriodRows = 40.0;
  });
  AppendEverywhere(all, "rolling shutter", White, [](RealSensorSetting & setting) {
    setting.settings.conditions.flickerSd = 0.03;
    setting.settings.rollingShutterPeriodRows = 150.0;
  });
  AppendEverywhere(all, "two lamps", White, [](RealSensorSetting & setting) {
    setting.settings.conditions.flickerSd = 0.03;
    setting.hasTwoSources = true;
  });
  return all;
}

Settings
MakeSmoothedSettings()
{
  return MakeStrengths<double>(
    { 0.4, 0.6, 0.8, 1.0 }, " px", Filtered, [](SensorFlaws & flaws, double sd) { flaws.smoothing.sdPixels = sd; });
}

Settings
MakeResampledSettings()
{
  Settings all;
  for (const Interpolation interpolation : { Interpolation::Linear, Interpolation::Cubic })
  {
    const Settings some = MakeStrengths<double>(
      { 0.2, 0.35, 0.5 },
      std::string(" px, ") + NameOf(interpolation),
      Filtered,
      [=](SensorFlaws & flaws, double shift) { flaws.resampling = { shift, shift, interpolation }; });
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Settings
MakeBinnedSettings()
{
  Settings all;
  for (const Interpolation interpolation : { Interpolation::Nearest, Interpolation::Linear })
  {
    AppendEverywhere(all, std::string("2 x 2, ") + NameOf(interpolation), Enlarged, [=](RealSensorSetting & setting) {
      setting.settings.flaws.binning = { 2, interpolation };
    });
  }
  return all;
}

/** Returns settings with coupling. The noise correlation of neighbouring pixels is about 2 f / (1 - 8 f), where f is
 * the coupled fraction. Above 2 % the noise class "filtered" is right as well. */
Settings
MakeCouplingSettings()
{
  const auto     apply = [](SensorFlaws & flaws, double fraction) { flaws.coupling.fraction = fraction; };
  Settings       all = MakeStrengths<double>({ 0.003, 0.006 }, " to each neighbour", { "crosstalk" }, apply);
  const Settings more =
    MakeStrengths<double>({ 0.012, 0.02 }, " to each neighbour", { "crosstalk", "filtered" }, apply);
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Settings
MakeBlurSettings()
{
  Settings all;
  for (const double sd : { 0.0, 1.0, 2.0 })
  {
    AppendEverywhere(all, ShortText(sd) + " px of the light", White, [=](RealSensorSetting & setting) {
      setting.settings.opticalBlurPixels = sd;
    });
  }
  return all;
}

Settings
MakeTemporalSettings()
{
  return MakeStrengths<double>({ 0.2, 0.4, 0.6 },
                               " of the last frame",
                               { "temporal" },
                               [](SensorFlaws & flaws, double weight) { flaws.temporalFilter.weight = weight; });
}

Settings
MakeRepeatedSettings()
{
  Settings all;
  AppendEverywhere(
    all, "each frame twice", White, [](RealSensorSetting & setting) { setting.settings.flaws.repetition = { 2, 1 }; });
  AppendEverywhere(all, "each third frame twice", White, [](RealSensorSetting & setting) {
    setting.settings.flaws.repetition = { 2, 3 };
  });
  return all;
}

Settings
MakeCompandedSettings()
{
  Settings all;
  for (const unsigned int bits : { 8u, 10u })
  {
    AppendEverywhere(all, "square root of " + std::to_string(bits) + " bits", {}, [=](RealSensorSetting & setting) {
      setting.settings.flaws.companding.bits = bits;
    });
  }
  return all;
}

Settings
MakeDefectSettings()
{
  return MakeStrengths<double>({ 1.5, 2.0, 2.5, 3.0 }, " sigma", NotWhite, [](SensorFlaws & flaws, double threshold) {
    flaws.defectCorrection.thresholdSd = threshold;
  });
}

Settings
MakeMedianSettings()
{
  return MakeStrengths<unsigned int>({ 1 }, " px radius", NotWhite, [](SensorFlaws & flaws, unsigned int radius) {
    flaws.median.radiusPixels = radius;
  });
}

Settings
MakeBlockSettings()
{
  return MakeStrengths<unsigned int>({ 85, 90, 95, 98 },
                                     " quality",
                                     NotWhite,
                                     [](SensorFlaws & flaws, unsigned int quality) { flaws.blocks.quality = quality; });
}

/** Returns settings in which the variance of the brightest level decreases by the fraction 8 k Q
 * (BrighterFatterSettings). */
Settings
MakeBrighterFatterSettings()
{
  Settings all;
  for (const double loss : { 0.02, 0.05 })
  {
    AppendEverywhere(
      all, ShortText(100.0 * loss) + " % at the top", { "brighter-fatter" }, [=](RealSensorSetting & setting) {
        setting.settings.flaws.brighterFatter.perElectron = loss / (8.0 * setting.settings.camera.electrons);
      });
  }
  return all;
}
} // namespace

void
AppendProcessedLines(std::vector<RealSensorLine> & lines)
{
  lines.push_back({ "plain", "white noise, row and column noise, banding, rolling shutter, lamps", MakePlainSettings });
  lines.push_back({ "smoothed", "the camera smooths its frames", MakeSmoothedSettings });
  lines.push_back({ "resampled", "the camera moves its frames along x and y", MakeResampledSettings });
  lines.push_back({ "binned", "the camera bins its frames and gives them their old size", MakeBinnedSettings });
  lines.push_back({ "coupling", "pixels give charge to their neighbours", MakeCouplingSettings });
  lines.push_back({ "blur", "the illumination is blurred before the photons are counted", MakeBlurSettings });
  lines.push_back({ "temporal", "the camera blends its frames with the last one", MakeTemporalSettings });
  lines.push_back({ "repeated", "frames are written twice", MakeRepeatedSettings });
  lines.push_back({ "companded", "square-root companding and back", MakeCompandedSettings });
  lines.push_back({ "defects", "pixels far from their neighbours become the neighbours' median", MakeDefectSettings });
  lines.push_back({ "median", "the camera takes the median of 3 x 3 pixels", MakeMedianSettings });
  lines.push_back({ "blocks", "JPEG-like quantization of 8 x 8 pixels", MakeBlockSettings });
  lines.push_back({ "brighter-fatter", "charge spreads in proportion to its square", MakeBrighterFatterSettings });
}

} // namespace sensornoise::tools
