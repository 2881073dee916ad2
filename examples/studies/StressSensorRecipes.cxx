// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "simulation/Random.h"
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
constexpr double        TopDn = 4095.0;
constexpr std::uint64_t TelegraphStream = 120;
constexpr std::uint64_t DriftStream = 122;

/** 1 % of the pixels are 20 DN higher in a random half of the frames (random telegraph noise). */
void
PrepareTelegraph(StressRecipe & recipe)
{
  const std::uint64_t       seed = recipe.settings.seed;
  std::vector<std::uint8_t> isRestless(recipe.size * recipe.size);
  CounterSeededRandom       random(seed, TelegraphStream);
  std::generate(isRestless.begin(), isRestless.end(), [&] { return random.Uniform() < 0.01 ? 1 : 0; });
  recipe.levelDn = [=](std::size_t t, std::size_t pixel) {
    return isRestless[pixel] != 0 && CounterSeededRandom(seed, TelegraphStream + 1, t, pixel).Uniform() < 0.5 ? 20.0
                                                                                                              : 0.0;
  };
}

/** The offset drifts slowly and equally in all pixels, with mean 0 and 3 DN rms over the burst. */
void
PrepareBlackDrift(StressRecipe & recipe)
{
  constexpr double    twoPi = 6.283185307179586476925;
  const auto          frames = static_cast<double>(recipe.settings.frames);
  CounterSeededRandom random(recipe.settings.seed, DriftStream);
  const double        phase = twoPi * random.Uniform();
  const double        secondPhase = twoPi * random.Uniform();
  std::vector<double> drift;
  double              sum = 0.0;
  double              squares = 0.0;
  for (double t = 0.0; t < frames; t += 1.0)
  {
    drift.push_back(std::sin(twoPi * 0.7 * t / frames + phase) +
                    0.5 * std::sin(twoPi * 2.3 * t / frames + secondPhase));
    sum += drift.back();
    squares += drift.back() * drift.back();
  }
  const double mean = sum / frames;
  const double rms = std::sqrt(squares / frames - mean * mean);
  std::for_each(drift.begin(), drift.end(), [=](double & value) { value = 3.0 * (value - mean) / rms; });
  recipe.levelDn = [drift](std::size_t t, std::size_t) { return drift[t]; };
}

/** The illumination is so high that 5 % of the pixels reach or would exceed the highest grey value. */
void
PrepareClippedHighlights(StressRecipe & recipe)
{
  const std::size_t   size = recipe.size;
  const double        blur = recipe.settings.opticalBlurPixels;
  std::vector<double> level = ScaleToRange(GaussianBlur(recipe.scene, size, size, blur), 0.0, 1.0);
  const auto          rank = level.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(level.size()));
  std::nth_element(level.begin(), rank, level.end());
  CameraModel & camera = recipe.settings.camera;
  camera.electrons = (TopDn - camera.offsetDn) / (camera.gainDnPerElectron * *rank);
}

/** Returns a case whose camera applies a tone curve to the grey value u: top (u / 4095)^(1 / gamma). */
StressRecipeEntry
MakeGammaEntry(const char * name, double gamma, double top)
{
  return { { name, "the digital numbers went through a tone curve, u^(1/gamma)", StressExpectation::Refused },
           [=](StressRecipe & recipe) {
             recipe.remap = [=](double greyValue) { return top * std::pow(greyValue / TopDn, 1.0 / gamma); };
             recipe.isEightBit = top < 256.0;
           } };
}

/** Returns a case with 3000 e- on 210 grey values of 8 bits. The read noise is below the quantization step. */
StressRecipeEntry
MakeCoarseEntry(const char * name, double readNoiseDn)
{
  return { { name, "8-bit digital numbers, read noise (hundredths of DN in the name) below the quantization step" },
           [=](StressRecipe & recipe) {
             recipe.settings.camera = { 3000.0, 0.07, 10.0, readNoiseDn };
             recipe.settings.bitDepth = 8;
             recipe.isEightBit = true;
           } };
}

StressRecipeEntry
MakeScaledEntry(const char * name, const char * what, double scale, std::uint16_t strayDn)
{
  return { { name, what }, [=](StressRecipe & recipe) {
            recipe.remap = [=](double greyValue) { return scale * greyValue; };
            recipe.scale = scale;
            recipe.strayDn = strayDn;
          } };
}
/** Appends sensors with a non-linear response, whose local gain deviates by up to 2 or 4 %. */
void
AppendNonlinearEntries(std::vector<StressRecipeEntry> & entries)
{
  for (const ResponseShape shape : { ResponseShape::Quadratic, ResponseShape::Wave, ResponseShape::Shoulder })
  {
    for (const int percent : { 2, -2, 4, -4 })
    {
      const std::string size = (percent > 0 ? "+" : "") + std::to_string(percent);
      entries.push_back({ { std::string(NameOf(shape)) + size,
                            "the response is non-linear, local gain by so many %",
                            StressExpectation::Nonlinear },
                          [=](StressRecipe & recipe) { recipe.settings.flaws.response = { shape, 0.01 * percent }; } });
    }
  }
}

/** Returns a case with a scientific CMOS camera. The read noise of its pixels has a median of 1.4 e- and a root mean
 * square of 1.8 e-; offsets and gains of the pixels differ. */
StressRecipeEntry
MakeScientificEntry(const char * name, const char * what, double electrons)
{
  return { { name, what }, [=](StressRecipe & recipe) {
            recipe.settings.camera = { electrons, 2.2, 100.0, 3.1 };
            recipe.settings.dsnuSdDn = 2.0;
            recipe.settings.flaws.pattern.gainSd = 0.01;
            recipe.settings.flaws.readNoise = { 0.25, 0.03, 1.0 };
          } };
}

/** Appends cases with fixed-pattern noise, row noise, column noise and banding. */
void
AppendPatternEntries(std::vector<StressRecipeEntry> & entries)
{
  const auto append = [&entries](const char * name, const char * what, auto change) {
    entries.push_back({ { name, what }, [=](StressRecipe & recipe) { change(recipe.settings.flaws); } });
  };
  append("gain_pattern", "gains of the pixels differ by 1 %", [](SensorFlaws & flaws) { flaws.pattern.gainSd = 0.01; });
  append("column_gain_pattern", "gains of the columns differ by 1 %", [](SensorFlaws & flaws) {
    flaws.pattern.columnGainSd = 0.01;
  });
  entries.push_back(MakeScientificEntry("scmos", "scientific CMOS: read noise with a tail, 500 e-", 500.0));
  entries.push_back(MakeScientificEntry("scmos30", "the same with 30 e- at the brightest", 30.0));
  append("row_noise", "each row of each frame is off by 2 DN rms", [](SensorFlaws & flaws) {
    flaws.lineNoise.rowNoiseSdDn = 2.0;
  });
  append("column_noise", "each column of each frame is off by 2 DN rms", [](SensorFlaws & flaws) {
    flaws.lineNoise.columnNoiseSdDn = 2.0;
  });
  append("banding", "a sine of 3 DN and 64 rows, phase anew in each frame", [](SensorFlaws & flaws) {
    flaws.lineNoise.bandingAmplitudeDn = 3.0;
  });
}
} // namespace

void
AppendSensorRecipes(std::vector<StressRecipeEntry> & entries)
{
  entries.push_back({ { "hot_pixels", "1 % of the pixels have 10 times the read noise" },
                      [](StressRecipe & recipe) { recipe.settings.hotPixelFraction = 0.01; } });
  entries.push_back({ { "telegraph", "1 % of the pixels jump by 20 DN at random" }, PrepareTelegraph });
  entries.push_back({ { "prnu_dsnu", "PRNU 1 %, DSNU 2 DN" }, [](StressRecipe & recipe) {
                       recipe.settings.prnuSd = 0.01;
                       recipe.settings.dsnuSdDn = 2.0;
                     } });
  entries.push_back({ { "black_drift", "the offset drifts slowly, 3 DN rms" }, PrepareBlackDrift });
  entries.push_back(
    { { "clipped_highlights", "5 % of the pixels exceed the 12-bit range" }, PrepareClippedHighlights });
  entries.push_back({ { "saturation60", "the sensor saturates at 60 % of the DN range" },
                      [](StressRecipe & recipe) { recipe.settings.clipHighDn = std::floor(0.6 * TopDn); } });
  entries.push_back({ { "floor_pedestal", "nothing below the offset is recorded" },
                      [](StressRecipe & recipe) { recipe.settings.clipLowDn = recipe.settings.camera.offsetDn; } });
  entries.push_back({ { "low_sigma", "gain 5 DN/e-, read noise 3 DN, condition 2" }, [](StressRecipe & recipe) {
                       recipe.settings.camera = { 600.0, 5.0, 200.0, 3.0 };
                       recipe.settings.conditions = PaperConditions(2);
                     } });
  entries.push_back(MakeCoarseEntry("eight_bit_coarse25", 0.25));
  entries.push_back(MakeCoarseEntry("eight_bit_coarse12", 0.12));
  entries.push_back(MakeScaledEntry("left_aligned16", "12-bit numbers times 16", 16.0, 0));
  entries.push_back(MakeScaledEntry("stray_code", "12-bit numbers times 16, one sample 5 higher", 16.0, 5));
  entries.push_back(MakeScaledEntry("rescaled", "12-bit numbers times 65535/4095, rounded", 65535.0 / TopDn, 0));
  entries.push_back(MakeGammaEntry("gamma13_12bit", 1.3, TopDn));
  entries.push_back(MakeGammaEntry("gamma22_12bit", 2.2, TopDn));
  entries.push_back(MakeGammaEntry("gamma13_8bit", 1.3, 255.0));
  entries.push_back(MakeGammaEntry("gamma22_8bit", 2.2, 255.0));
  AppendNonlinearEntries(entries);
  AppendPatternEntries(entries);
}

} // namespace sensornoise::tools
