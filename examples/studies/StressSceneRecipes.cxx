// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "simulation/Random.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "studies/StressRecipe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using Row = StressRecipe::RowOfElectrons;

constexpr double        Pi = 3.14159265358979323846;
constexpr std::uint64_t SeriesStream = 110;

/** Returns a smooth random function of the rows for each frame [1], independent from frame to frame. It is a sum of
 * 32 waves with normal wave numbers, a nearly Gaussian process. Its covariance at distance d is sd^2 exp(-d^2 / (2
 * length^2)). */
std::vector<double>
DrawFlickerOfRows(const StressRecipe & recipe, double sd, double lengthRows)
{
  constexpr int       waves = 32;
  std::vector<double> gamma(recipe.settings.frames * recipe.size, 0.0);
  for (std::size_t t = 0; t < recipe.settings.frames; ++t)
  {
    CounterSeededRandom random(recipe.settings.seed, SeriesStream, t);
    for (int k = 0; k < waves; ++k)
    {
      const double waveNumber = random.Normal() / lengthRows;
      const double phase = 2.0 * Pi * random.Uniform();
      for (std::size_t y = 0; y < recipe.size; ++y)
      {
        gamma[t * recipe.size + y] +=
          sd * std::sqrt(2.0 / waves) * std::cos(waveNumber * static_cast<double>(y) + phase);
      }
    }
  }
  return gamma;
}

void
PrepareRandomRolling(StressRecipe & recipe)
{
  recipe.settings.conditions.flickerSd = 0.0;
  const auto gamma = DrawFlickerOfRows(recipe, 0.05, 200.0);
  recipe.illuminate = [gamma, size = recipe.size](const auto &, std::size_t t, std::size_t y, Row & electrons) {
    for (double & value : electrons)
    {
      value *= std::max(0.0, 1.0 + gamma[t * size + y]);
    }
  };
}

/** Two light sources have independent flicker. The fraction of the second source rises from 0 to 1 along the diagonal
 * of the frame. */
void
PrepareTwoSources(StressRecipe & recipe)
{
  recipe.settings.conditions.flickerSd = 0.0;
  std::vector<double> gamma;
  for (std::size_t t = 0; t < recipe.settings.frames; ++t)
  {
    CounterSeededRandom random(recipe.settings.seed, SeriesStream, t);
    gamma.push_back(0.05 * random.Normal());
    gamma.push_back(0.05 * random.Normal());
  }
  recipe.illuminate = [gamma](const auto &, std::size_t t, std::size_t y, Row & electrons) {
    for (std::size_t x = 0; x < electrons.size(); ++x)
    {
      const double along = static_cast<double>(x + y) / (2.0 * static_cast<double>(electrons.size()) - 2.0);
      const double fraction = 0.5 - 0.5 * std::cos(Pi * along);
      electrons[x] *= 1.0 + (1.0 - fraction) * gamma[2 * t] + fraction * gamma[2 * t + 1];
    }
  };
}

/** All of the signal decays exponentially by 20 % over the burst, or with \a isMixed a smooth pattern that is half
 * of the signal. */
void
PrepareBleaching(StressRecipe & recipe, bool isMixed)
{
  const double rate = std::log(0.8) / static_cast<double>(recipe.settings.frames - 1);
  recipe.illuminate = [rate, isMixed](const auto &, std::size_t t, std::size_t y, Row & electrons) {
    const double decay = std::exp(rate * static_cast<double>(t));
    const double scale = 3.0 * Pi / static_cast<double>(electrons.size());
    for (std::size_t x = 0; x < electrons.size(); ++x)
    {
      const double wave = std::sin(scale * static_cast<double>(x)) * std::sin(scale * static_cast<double>(y) + 0.5);
      const double fraction = isMixed ? 0.5 + 0.5 * wave : 1.0;
      electrons[x] *= 1.0 - fraction + fraction * decay;
    }
  };
}

/** A disk with 5 % of the area and an edge one pixel wide crosses the scene on a slanted path. */
void
PrepareMovingDisk(StressRecipe & recipe)
{
  const auto   size = static_cast<double>(recipe.size);
  const double radius = size * std::sqrt(0.05 / Pi);
  const double brightness = 0.6 * recipe.settings.camera.electrons;
  const double last = static_cast<double>(recipe.settings.frames - 1);
  recipe.illuminate = [=](const SimulatedSeries & series, std::size_t t, std::size_t y, Row & electrons) {
    const double along = static_cast<double>(t) / last;
    const double dy = static_cast<double>(y) - size * (0.4 + 0.2 * along);
    for (std::size_t x = 0; x < electrons.size(); ++x)
    {
      const double dx = static_cast<double>(x) - (along * (size + 2.0 * radius) - radius);
      const double cover = std::clamp(radius + 0.5 - std::hypot(dx, dy), 0.0, 1.0);
      electrons[x] += cover * (brightness * (1.0 + series.gamma[t]) - electrons[x]);
    }
  };
}

/** A textured block with a third of the width crosses from left to right over the lower two thirds of the rows. */
void
PrepareCrossingBlock(StressRecipe & recipe)
{
  constexpr std::uint64_t blockSeed = 41;
  const std::size_t       blockWidth = recipe.size / 3;
  const std::size_t       top = recipe.size / 3;
  const auto              block = ScaleToRange(
    MakeTextureScene(blockWidth, recipe.size - top, blockSeed), 0.1, 0.9 * recipe.settings.camera.electrons);
  const auto   width = static_cast<double>(blockWidth);
  const double travel = static_cast<double>(recipe.size) + width;
  const double last = static_cast<double>(recipe.settings.frames - 1);
  recipe.illuminate = [=](const SimulatedSeries & series, std::size_t t, std::size_t y, Row & electrons) {
    const double left = travel * static_cast<double>(t) / last - width;
    for (std::size_t x = 0; x < electrons.size() && y >= top; ++x)
    {
      const double at = static_cast<double>(x) - left; // position in the block [pixel]
      if (at >= 0.0 && at <= width - 1.0)
      {
        const double * row = block.data() + (y - top) * blockWidth;
        const auto     first = static_cast<std::size_t>(at);
        const auto     second = std::min(first + 1, blockWidth - 1);
        const double   value = row[first] + (at - std::floor(at)) * (row[second] - row[first]);
        electrons[x] = value * (1.0 + series.gamma[t]);
      }
    }
  };
}

/** The middle quarter of the frame moves horizontally as a sine of amplitude 2 pixels and period 17.3 frames. */
void
PrepareWavingQuarter(StressRecipe & recipe)
{
  recipe.illuminate = [](const auto &, std::size_t t, std::size_t y, Row & electrons) {
    const std::size_t first = electrons.size() / 4;
    const std::size_t end = first + electrons.size() / 2;
    const double      shift = 2.0 * std::sin(2.0 * Pi * static_cast<double>(t) / 17.3);
    const double      whole = std::floor(shift);
    if (y >= first && y < end)
    {
      const Row unshifted = electrons;
      for (std::size_t x = first; x < end; ++x)
      {
        const auto from = x + static_cast<std::size_t>(whole + 2.0) - 2;
        electrons[x] = unshifted[from] + (shift - whole) * (unshifted[from + 1] - unshifted[from]);
      }
    }
  };
}

void
PrepareBrightFrame(StressRecipe & recipe)
{
  recipe.illuminate = [middle = recipe.settings.frames / 2](const auto &, std::size_t t, std::size_t, Row & electrons) {
    for (double & value : electrons)
    {
      value *= t == middle ? 1.2 : 1.0;
    }
  };
}

void
PrepareVeil(StressRecipe & recipe)
{
  recipe.illuminate = [](const auto &, std::size_t, std::size_t, Row & electrons) {
    for (double & value : electrons)
    {
      value += 200.0;
    }
  };
}

/** Appends strong changes of the illumination, with the shapes of IlluminationOf(). */
void
AppendIlluminationRecipes(std::vector<StressRecipeEntry> & entries)
{
  const auto append = [&entries](const char * name, const char * what, const char * illumination, double electrons) {
    entries.push_back({ { name, what }, [=](StressRecipe & recipe) {
                         recipe.settings.illumination = IlluminationOf(illumination);
                         recipe.settings.camera.electrons *= electrons;
                       } });
  };
  append("pulses0.3", "every fourth frame is bright, the others have 30 % of its illumination", "pulses:0.3:4", 1.0);
  append("ramp0", "the illumination rises linearly from 0", "ramp:0", 1.0);
  append("decay0.1", "the illumination decays exponentially to 10 %", "decay:0.1", 1.0);
  append("sine0.1", "the illumination is a sine from 10 % to 100 %, with a period of 9 frames", "sine:0.1:9", 1.0);
  // The brightest of 100 frames has about 5 times the mean illumination. With all electrons most of its pixels would
  // clip.
  append("exponential", "the illumination is an exponential random number, 1 / 5 of the electrons", "exponential", 0.2);
}
} // namespace

void
AppendSceneRecipes(std::vector<StressRecipeEntry> & entries)
{
  entries.push_back({ { "plain", "camera B, condition 3, nothing added" }, [](StressRecipe &) {} });
  for (const int period : { 2000, 600, 200, 80 })
  {
    entries.push_back({ { "rolling" + std::to_string(period), "rolling shutter, bands of so many rows" },
                        [=](StressRecipe & recipe) { recipe.settings.rollingShutterPeriodRows = period; } });
  }
  entries.push_back({ { "rolling_random200", "smooth random flicker of the rows, 5 %, correlated over 200 rows" },
                      PrepareRandomRolling });
  entries.push_back(
    { { "two_lamps", "two lamps with 5 % flicker each, each with its own part of the scene" }, PrepareTwoSources });
  entries.push_back({ { "bleach_uniform", "all of the signal decays by 20 %, flicker 1 %" }, [](StressRecipe & recipe) {
                       recipe.settings.conditions.flickerSd = 0.01;
                       PrepareBleaching(recipe, false);
                     } });
  entries.push_back({ { "bleach_mixed", "a smooth half of the signal decays by 20 %, flicker 5 %" },
                      [](StressRecipe & recipe) { PrepareBleaching(recipe, true); } });
  entries.push_back({ { "moving_disk", "a disk of 5 % of the area crosses the scene" }, PrepareMovingDisk });
  entries.push_back({ { "crossing_block", "a textured block, a third of the width, crosses two thirds of the rows" },
                      PrepareCrossingBlock });
  entries.push_back({ { "waving_quarter", "a quarter of the frame sways by 2 pixels" }, PrepareWavingQuarter });
  entries.push_back({ { "bright_frame", "one frame is 20 % brighter" }, PrepareBrightFrame });
  entries.push_back({ { "no_flicker", "the illumination is perfectly steady" },
                      [](StressRecipe & recipe) { recipe.settings.conditions.flickerSd = 0.0; } });
  entries.push_back({ { "flicker0.001", "flicker 0.1 %" },
                      [](StressRecipe & recipe) { recipe.settings.conditions.flickerSd = 0.001; } });
  entries.push_back(
    { { "veil200", "200 e- of steady veiling signal: by flicker alone the offset is found 200 DN too high" },
      PrepareVeil });
  for (const double shift : { 0.5, 1.0 })
  {
    entries.push_back({ { shift < 1.0 ? "vibration0.5" : "vibration1.0", "vibration of so many pixels rms in x and y" },
                        [=](StressRecipe & recipe) {
                          recipe.settings.conditions.vibrationSdXPixels = shift;
                          recipe.settings.conditions.vibrationSdYPixels = shift;
                        } });
  }
  for (const int frames : { 5, 10, 20 })
  {
    entries.push_back({ { "T" + std::to_string(frames), "a burst of so many frames" },
                        [=](StressRecipe & recipe) { recipe.settings.frames = static_cast<std::size_t>(frames); } });
  }
  AppendIlluminationRecipes(entries);
}

} // namespace sensornoise::tools
