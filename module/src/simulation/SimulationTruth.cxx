// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"

#include "simulation/Illumination.h"
#include "simulation/Random.h"
#include "simulation/RandomStreams.h"
#include "simulation/ReadOut.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace sensornoise
{
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

} // namespace sensornoise
