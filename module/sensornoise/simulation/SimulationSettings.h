/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_simulation_SimulationSettings_h
#define sensornoise_simulation_SimulationSettings_h

#include "sensornoise/simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

/** The camera: the left half of Table 1 of Sur and Grediac 2015 (DOI 10.1137/140977035). The default is camera B. */
struct CameraModel
{
  /** A, electrons of the brightest pixel of the scene [e-], above 0 and at most 1e9. */
  double electrons{ 3000.0 };
  /** g [DN/e-], above 0. */
  double gainDnPerElectron{ 1.0 };
  /** mu, level without light [DN]. */
  double offsetDn{ 100.0 };
  /** sigma, standard deviation of the noise without light [DN], 0 or more. */
  double readNoiseDn{ 8.0 };
};

/** Cameras A, B and C of Table 1. */
inline CameraModel
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

/** The light and the floor: the right half of Table 1. The default is condition 3, the realistic one. */
struct SceneConditions
{
  /** Standard deviation of the flicker gamma_t [1], 0 or more. */
  double flickerSd{ 0.05 };
  /** Standard deviation of the horizontal shift alpha_t [pixel], 0 or more. */
  double vibrationSdXPixels{ 0.01 };
  /** Standard deviation of the vertical shift beta_t [pixel], 0 or more. */
  double vibrationSdYPixels{ 0.02 };
};

/** Experimental conditions 1, 2 and 3 of Table 1. */
inline SceneConditions
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

/** All that a simulated stack depends on, beside the reference image. */
struct SimulationSettings
{
  CameraModel     camera{};
  SceneConditions conditions{};
  /** T, at least 1. */
  std::size_t frames{ 100 };
  /** Bits of the analogue-to-digital converter, 0 to 32: integer pixels are clipped to [0, 2^bitDepth - 1]; 0 leaves
   * them the whole range of their type. */
  unsigned int bitDepth{ 12 };
  /** The same seed gives the same stack. */
  std::uint64_t seed{ 1 };
  /** Standard deviation of the Gaussian blur of the optics [pixel], 0 or more; the paper has 0.5. */
  double opticalBlurPixels{ 0.5 };
  /** 0: the flicker gamma_t is one normal number a frame (global shutter). Above 0: a lamp that pulses while the rows
   * are read one after the other, gamma_t(y) = sqrt(2) flickerSd sin(2 pi y / period + phase_t), phase uniform [row].
   */
  double rollingShutterPeriodRows{ 0.0 };
  /** Floor of the sensor [DN]; not set: none. */
  std::optional<double> clipLowDn{};
  /** Level at which the sensor saturates [DN]; not set: none. */
  std::optional<double> clipHighDn{};
  /** Photo-response non-uniformity: standard deviation of the pixels' relative sensitivity [1], 0 or more. */
  double prnuSd{ 0.0 };
  /** Dark-signal non-uniformity: standard deviation of the pixels' offset about offsetDn [DN], 0 or more. */
  double dsnuSdDn{ 0.0 };
  /** Fraction of the pixels with excess read noise, from 0 to 1. */
  double hotPixelFraction{ 0.0 };
  /** Read noise of those pixels in units of the others', 0 or more. */
  double hotPixelNoiseFactor{ 10.0 };
};

/** The random numbers that are common to a frame, one each per frame. */
struct SimulatedSeries
{
  /** Flicker gamma_t [1]; with a rolling shutter its mean over the rows. */
  std::vector<double> gamma;
  /** Horizontal shift [pixel]: the frame shows p(x + alpha, y + beta). */
  std::vector<double> alpha;
  /** Vertical shift [pixel]. */
  std::vector<double> beta;
  /** Phase of the lamp at row 0 [rad], for the rolling shutter. */
  std::vector<double> phase;
};

/** What an estimator of a simulated stack should find. The scale and the position of the scene are free, so only
 * (1 + gamma_t) / mean(1 + gamma) - 1 and the spread of the shifts can be found. */
struct SimulationTruth
{
  SimulationSettings settings;
  SimulatedSeries    series;
  /** (1 + gamma_t) / mean(1 + gamma) - 1, one per frame [1]. */
  std::vector<double> normalisedFlicker;
  /** Standard deviation of the normalised flicker of this stack (divisor T - 1) [1]; with a rolling shutter the root
   * mean square over the rows of that of each row. NaN for one frame, as are the two below. */
  double realisedFlickerSd{ 0.0 };
  /** Standard deviation of this stack's alpha (divisor T - 1) [pixel]. */
  double realisedVibrationSdXPixels{ 0.0 };
  /** Standard deviation of this stack's beta (divisor T - 1) [pixel]. */
  double realisedVibrationSdYPixels{ 0.0 };
};

/** Flicker gamma_t(y) of row `y` of frame `frame` [1]. */
inline double
FlickerOfRow(const SimulationSettings & settings, const SimulatedSeries & series, std::size_t frame, std::size_t y)
{
  if (settings.rollingShutterPeriodRows == 0.0)
  {
    return series.gamma[frame];
  }
  constexpr double twoPi = 6.283185307179586476925;
  const double     angle = twoPi * static_cast<double>(y) / settings.rollingShutterPeriodRows + series.phase[frame];
  return std::sqrt(2.0) * settings.conditions.flickerSd * std::sin(angle);
}

/** \throws std::invalid_argument naming the first setting that cannot be used. */
inline void
CheckSettings(const SimulationSettings & settings)
{
  const auto require = [](bool isGood, const char * name, double found, const char * expected) {
    if (!isGood)
    {
      throw std::invalid_argument(std::string("the ") + name + " is " + std::to_string(found) + "; expected " +
                                  expected);
    }
  };
  const auto requireNotNegative = [&](double value, const char * name) {
    require(std::isfinite(value) && value >= 0.0, name, value, "a finite number, 0 or more");
  };
  const CameraModel & camera = settings.camera;
  require(camera.electrons > 0.0 && camera.electrons <= 1e9, "number of electrons", camera.electrons, "0 < A <= 1e9");
  require(std::isfinite(camera.gainDnPerElectron) && camera.gainDnPerElectron > 0.0,
          "gain",
          camera.gainDnPerElectron,
          "a finite number above 0");
  require(std::isfinite(camera.offsetDn), "offset", camera.offsetDn, "a finite number");
  requireNotNegative(camera.readNoiseDn, "read noise");
  requireNotNegative(settings.conditions.flickerSd, "flicker standard deviation");
  requireNotNegative(settings.conditions.vibrationSdXPixels, "horizontal vibration standard deviation");
  requireNotNegative(settings.conditions.vibrationSdYPixels, "vertical vibration standard deviation");
  require(settings.frames >= 1, "number of frames", static_cast<double>(settings.frames), "at least 1");
  require(settings.bitDepth <= 32, "bit depth", settings.bitDepth, "0 (no clipping) to 32");
  require(settings.opticalBlurPixels >= 0.0 && settings.opticalBlurPixels <= 1000.0,
          "optical blur",
          settings.opticalBlurPixels,
          "0 to 1000 pixels");
  requireNotNegative(settings.rollingShutterPeriodRows, "rolling-shutter period");
  requireNotNegative(settings.prnuSd, "PRNU");
  requireNotNegative(settings.dsnuSdDn, "DSNU");
  requireNotNegative(settings.hotPixelNoiseFactor, "noise factor of hot pixels");
  require(settings.hotPixelFraction >= 0.0 && settings.hotPixelFraction <= 1.0,
          "fraction of hot pixels",
          settings.hotPixelFraction,
          "0 to 1");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double     low = settings.clipLowDn.value_or(-infinity);
  const double     high = settings.clipHighDn.value_or(infinity);
  if (!(low < high))
  {
    throw std::invalid_argument("the clip levels are " + std::to_string(low) + " and " + std::to_string(high) +
                                "; expected the low one below the high one");
  }
}

/** Draws the series of a stack of frames with `height` rows and works out what an estimator should find. The numbers of
 * a frame depend on the seed and on the frame alone: a longer stack begins with the shorter one.
 * \throws std::invalid_argument if a setting cannot be used. */
inline SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t height)
{
  CheckSettings(settings);
  constexpr std::uint64_t seriesStream = 1;
  constexpr double        twoPi = 6.283185307179586476925;
  const std::size_t       frames = settings.frames;
  SimulationTruth         truth;
  truth.settings = settings;
  SimulatedSeries & series = truth.series;
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    CounterSeededRandom random(settings.seed, seriesStream, frame);
    series.gamma.push_back(settings.conditions.flickerSd * random.Normal());
    series.alpha.push_back(settings.conditions.vibrationSdXPixels * random.Normal());
    series.beta.push_back(settings.conditions.vibrationSdYPixels * random.Normal());
    series.phase.push_back(twoPi * random.Uniform());
  }
  const auto meanOf = [frames](auto valueOf) {
    double sum = 0.0;
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
      sum += valueOf(frame);
    }
    return sum / static_cast<double>(frames);
  };
  const auto varianceOf = [&](auto valueOf) {
    const double mean = meanOf(valueOf);
    const double biased = meanOf([&](std::size_t t) { return (valueOf(t) - mean) * (valueOf(t) - mean); });
    return frames > 1 ? biased * static_cast<double>(frames) / static_cast<double>(frames - 1)
                      : std::numeric_limits<double>::quiet_NaN();
  };
  // A global shutter is the case of one row that stands for all.
  const std::size_t   rows = settings.rollingShutterPeriodRows > 0.0 ? height : 1;
  std::vector<double> frameMeans(frames, 0.0);
  double              flickerVariance = 0.0;
  for (std::size_t y = 0; y < rows; ++y)
  {
    const auto   brightness = [&](std::size_t t) { return 1.0 + FlickerOfRow(settings, series, t, y); };
    const double mean = meanOf(brightness);
    flickerVariance += varianceOf(brightness) / (mean * mean * static_cast<double>(rows));
    for (std::size_t t = 0; t < frames; ++t)
    {
      frameMeans[t] += FlickerOfRow(settings, series, t, y) / static_cast<double>(rows);
    }
  }
  series.gamma = frameMeans;
  const double meanBrightness = 1.0 + meanOf([&](std::size_t t) { return series.gamma[t]; });
  for (const double gamma : series.gamma)
  {
    truth.normalisedFlicker.push_back((1.0 + gamma) / meanBrightness - 1.0);
  }
  truth.realisedFlickerSd = std::sqrt(flickerVariance);
  truth.realisedVibrationSdXPixels = std::sqrt(varianceOf([&](std::size_t t) { return series.alpha[t]; }));
  truth.realisedVibrationSdYPixels = std::sqrt(varianceOf([&](std::size_t t) { return series.beta[t]; }));
  return truth;
}

} // namespace sensornoise

#endif // sensornoise_simulation_SimulationSettings_h
