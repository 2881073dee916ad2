// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SimulationSettings.h"

#include "base/Text.h"
#include "report/JsonWriter.h"
#include "sensornoise/Simulator.h"
#include "simulation/SimulatedSensor.h"
#include "simulation/FrameProcessing.h"
#include "simulation/Random.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
/** \throws std::invalid_argument if the setting cannot be used. */
void
CheckSettings(const RepetitionSettings & settings)
{
  RequireSetting(
    settings.count >= 1, "number of times that a frame is written", static_cast<double>(settings.count), "1 or more");
  RequireSetting(
    settings.period >= 1, "period of repeated frames", static_cast<double>(settings.period), "1 or more exposures");
}
} // namespace

CameraModel
PaperCamera(char name)
{
  switch (name)
  {
    case 'A':
      return { 600.0, 5.0, 200.0, 15.0 };
    case 'B':
      return { 3000.0, 1.0, 100.0, 8.0 };
    case 'C':
      return { 10000.0, 0.3, 40.0, 3.0 };
    default:
      throw std::invalid_argument(std::string("camera \"") + name + "\" is not known; expected A, B or C");
  }
}

SceneConditions
PaperConditions(int number)
{
  switch (number)
  {
    case 1:
      return { 0.1, 0.3, 0.2 };
    case 2:
      return { 0.01, 0.1, 0.05 };
    case 3:
      return { 0.05, 0.01, 0.02 };
    default:
      throw std::invalid_argument("condition " + std::to_string(number) + " is not known; expected 1, 2 or 3");
  }
}

void
CheckSettings(const SimulationSettings & settings)
{
  const CameraModel & camera = settings.camera;
  RequireSetting(
    camera.electrons > 0.0 && camera.electrons <= 1e9, "number of electrons", camera.electrons, "0 < A <= 1e9");
  RequireSetting(camera.gainDnPerElectron > 0.0 && camera.gainDnPerElectron <= 1e9,
                 "gain",
                 camera.gainDnPerElectron,
                 "a number above 0, at most 1e9");
  RequireSetting(std::abs(camera.offsetDn) <= 1e9, "offset", camera.offsetDn, "-1e9 to 1e9");
  RequireNotNegative(camera.readNoiseDn, "read noise");
  RequireNotNegative(settings.conditions.flickerSd, "flicker standard deviation");
  RequireNotNegative(settings.conditions.vibrationSdXPixels, "horizontal vibration standard deviation");
  RequireNotNegative(settings.conditions.vibrationSdYPixels, "vertical vibration standard deviation");
  RequireSetting(settings.frames >= 1, "number of frames", static_cast<double>(settings.frames), "at least 1");
  CheckSettings(settings.illumination, settings.frames);
  RequireSetting(settings.bitDepth <= 32, "bit depth", settings.bitDepth, "0 (no clipping) to 32");
  RequireSetting(settings.opticalBlurPixels >= 0.0 && settings.opticalBlurPixels <= 1000.0,
                 "optical blur",
                 settings.opticalBlurPixels,
                 "0 to 1000 pixels");
  RequireNotNegative(settings.rollingShutterPeriodRows, "rolling-shutter period");
  RequireNotNegative(settings.prnuSd, "PRNU");
  RequireNotNegative(settings.dsnuSdDn, "DSNU");
  RequireNotNegative(settings.hotPixelNoiseFactor, "noise factor of hot pixels");
  RequireFraction(settings.hotPixelFraction, "fraction of hot pixels");
  CheckSettings(settings.flaws.filters);
  CheckSettings(settings.flaws.pattern);
  CheckSettings(settings.flaws.readNoise);
  CheckSettings(settings.flaws.response);
  CheckSettings(settings.flaws.lineNoise);
  CheckSettings(settings.flaws.brighterFatter, camera.electrons);
  CheckSettings(settings.flaws.coupling);
  CheckSettings(settings.flaws.defectCorrection);
  CheckSettings(settings.flaws.temporalFilter);
  CheckSettings(settings.flaws.median);
  CheckSettings(settings.flaws.smoothing);
  CheckSettings(settings.flaws.binning);
  CheckSettings(settings.flaws.resampling);
  CheckSettings(settings.flaws.blocks, settings.bitDepth);
  CheckSettings(settings.flaws.companding, settings.bitDepth);
  CheckSettings(settings.flaws.repetition);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double     low = settings.clipLowDn.value_or(-infinity);
  const double     high = settings.clipHighDn.value_or(infinity);
  if (!(low < high))
  {
    throw std::invalid_argument("the clip levels are " + Text(low) + " and " + Text(high) +
                                "; expected the low one below the high one");
  }
}

namespace
{
constexpr double TwoPi = 6.283185307179586476925;

/** Returns gamma of a frame with this illumination factor and flicker. A factor of 1 keeps the bits of the flicker. */
double
Brightened(double factor, double flicker)
{
  return factor == 1.0 ? flicker : factor * (1.0 + flicker) - 1.0;
}

SimulatedSeries
DrawSeries(const SimulationSettings & settings)
{
  SimulatedSeries series;
  for (std::size_t frame = 0; frame < settings.frames; ++frame)
  {
    const std::size_t   exposure = settings.flaws.repetition.ExposureOf(frame);
    CounterSeededRandom random(settings.seed, StreamNumber(RandomStream::Series), exposure);
    series.factor.push_back(IlluminationFactor(settings.illumination, exposure, settings.frames, settings.seed));
    series.gamma.push_back(Brightened(series.factor.back(), settings.conditions.flickerSd * random.Normal()));
    series.alpha.push_back(settings.conditions.vibrationSdXPixels * random.Normal());
    series.beta.push_back(settings.conditions.vibrationSdYPixels * random.Normal());
    series.phase.push_back(TwoPi * random.Uniform());
  }
  return series;
}

/** Returns the mean over the frames of valueOf(frame). */
template <typename TFunction>
double
MeanOf(std::size_t frames, TFunction valueOf)
{
  double sum = 0.0;
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    sum += valueOf(frame);
  }
  return sum / static_cast<double>(frames);
}

/** Returns the variance over the frames of valueOf(frame), divisor T - 1; NaN for one frame. */
template <typename TFunction>
double
VarianceOf(std::size_t frames, TFunction valueOf)
{
  const double mean = MeanOf(frames, valueOf);
  const double biased = MeanOf(frames, [&](std::size_t t) { return (valueOf(t) - mean) * (valueOf(t) - mean); });
  return frames > 1 ? biased * static_cast<double>(frames) / static_cast<double>(frames - 1)
                    : std::numeric_limits<double>::quiet_NaN();
}
} // namespace

double
FlickerOfRow(const SimulationSettings & settings, const SimulatedSeries & series, std::size_t frame, std::size_t y)
{
  if (settings.rollingShutterPeriodRows == 0.0)
  {
    return series.gamma[frame];
  }
  const double angle = TwoPi * static_cast<double>(y) / settings.rollingShutterPeriodRows + series.phase[frame];
  return Brightened(series.factor[frame], std::sqrt(2.0) * settings.conditions.flickerSd * std::sin(angle));
}

SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t height)
{
  CheckSettings(settings);
  const std::size_t frames = settings.frames;
  SimulationTruth   truth;
  truth.settings = settings;
  truth.series = DrawSeries(settings);
  SimulatedSeries & series = truth.series;
  // With a global shutter one row represents all rows.
  const std::size_t   rows = settings.rollingShutterPeriodRows > 0.0 ? height : 1;
  std::vector<double> frameMeans(frames, 0.0);
  double              flickerVariance = 0.0;
  for (std::size_t y = 0; y < rows; ++y)
  {
    const auto   brightness = [&](std::size_t t) { return 1.0 + FlickerOfRow(settings, series, t, y); };
    const double mean = MeanOf(frames, brightness);
    flickerVariance += VarianceOf(frames, brightness) / (mean * mean * static_cast<double>(rows));
    for (std::size_t t = 0; t < frames; ++t)
    {
      frameMeans[t] += FlickerOfRow(settings, series, t, y) / static_cast<double>(rows);
    }
  }
  series.gamma = frameMeans;
  const double meanBrightness = 1.0 + MeanOf(frames, [&](std::size_t t) { return series.gamma[t]; });
  for (const double gamma : series.gamma)
  {
    truth.normalisedFlicker.push_back((1.0 + gamma) / meanBrightness - 1.0);
  }
  truth.realisedFlickerSd = std::sqrt(flickerVariance);
  truth.realisedVibrationSdXPixels = std::sqrt(VarianceOf(frames, [&](std::size_t t) { return series.alpha[t]; }));
  truth.realisedVibrationSdYPixels = std::sqrt(VarianceOf(frames, [&](std::size_t t) { return series.beta[t]; }));
  return truth;
}

SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t width, std::size_t height)
{
  SimulationTruth truth = DrawTruth(settings, height);
  const auto      readNoise = ReadOut(settings, width, height).SummariseReadNoise();
  truth.realisedReadNoiseRmsDn = readNoise.rmsDn;
  truth.realisedReadNoiseMedianDn = readNoise.medianDn;
  return truth;
}

/** Writes the settings of the flaws, a member for each of them. The members have the names and the units of the
 * settings, without the unit at the end of the name. */
void
WriteJson(JsonWriter & json, const SensorFlaws & flaws)
{
  json.Object([&] {
    json.ObjectMember("filters", [&] {
      const ColourFilterSettings & filters = flaws.filters;
      json.Member("bayer", filters.pattern ? NameOf(*filters.pattern) : "none");
      json.Member("transmission",
                  std::array<double, 3>{ filters.transmissionR, filters.transmissionG, filters.transmissionB });
    });
    json.ObjectMember("pattern", [&] {
      json.Member("gain_sd", flaws.pattern.gainSd).Member("column_gain_sd", flaws.pattern.columnGainSd);
      json.Member("column_efficiency_sd", flaws.pattern.columnEfficiencySd);
      json.Member("column_offset_sd", flaws.pattern.columnOffsetSdDn);
    });
    json.Member("brighter_fatter_per_electron", flaws.brighterFatter.perElectron);
    json.Member("coupling_fraction", flaws.coupling.fraction);
    json.ObjectMember("read_noise", [&] {
      json.Member("spread", flaws.readNoise.spread).Member("tail_fraction", flaws.readNoise.tailFraction);
      json.Member("tail_spread", flaws.readNoise.tailSpread);
    });
    json.ObjectMember("response", [&] {
      json.Member("shape", NameOf(flaws.response.shape)).Member("size", flaws.response.size);
      json.Member("full_scale_electrons", flaws.response.fullScaleElectrons);
    });
    json.ObjectMember("line_noise", [&] {
      json.Member("row_noise_sd", flaws.lineNoise.rowNoiseSdDn);
      json.Member("column_noise_sd", flaws.lineNoise.columnNoiseSdDn);
      json.Member("banding_amplitude", flaws.lineNoise.bandingAmplitudeDn);
      json.Member("banding_period", flaws.lineNoise.bandingPeriodRows);
    });
    json.Member("defect_threshold_sd", flaws.defectCorrection.thresholdSd);
    json.Member("temporal_filter_weight", flaws.temporalFilter.weight);
    json.Member("median_radius", flaws.median.radiusPixels);
    json.Member("smoothing_sd", flaws.smoothing.sdPixels);
    json.ObjectMember("binning", [&] {
      json.Member("factor", flaws.binning.factor).Member("interpolation", NameOf(flaws.binning.interpolation));
    });
    json.Member("resampling_shift",
                std::array<double, 2>{ flaws.resampling.shiftXPixels, flaws.resampling.shiftYPixels });
    json.Member("resampling_interpolation", NameOf(flaws.resampling.interpolation));
    json.Member("block_quality", flaws.blocks.quality);
    json.Member("companding_bits", flaws.companding.bits);
    json.Member("repeat_count", flaws.repetition.count).Member("repeat_period", flaws.repetition.period);
  });
}

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
    json.Member("total_intercept", intercept + 1.0 / 12.0); // includes the quantization noise
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
