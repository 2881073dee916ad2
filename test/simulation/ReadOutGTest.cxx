// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "helpers/SimulatorTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

namespace
{
constexpr std::size_t Width = 60;
constexpr std::size_t Height = 50;

/** Every pattern at once. */
SimulationSettings
PatternedSettings()
{
  SimulationSettings settings = StaticSettings('A', 1);
  settings.dsnuSdDn = 3.0;
  settings.hotPixelFraction = 0.02;
  settings.flaws.pattern = { 0.02, 0.01, 0.0, 2.0 };
  settings.flaws.readNoise = { 0.2, 0.05, 0.8 };
  return settings;
}

double
OutputOf(const ReadOut & readOut, std::size_t pixel, double electrons, double normal)
{
  std::vector<double> charge(Width, electrons);
  std::vector<double> greyValues(Width, normal);
  readOut.ReadRow(0, pixel / Width, charge.data(), greyValues.data(), greyValues.data());
  return greyValues[pixel % Width];
}
} // namespace

TEST(SensorNoiseReadOut, OutputIsOffsetGainAndReadNoiseOfThePixel)
{
  const SimulationSettings settings = PatternedSettings();
  const ReadOut            readOut(settings, Width, Height);
  const auto               gain = DrawGainPattern(settings.flaws.pattern, settings.seed, Width, Height);
  const auto               offsetDn = DrawOffsetDn(settings, Width, Height);
  const auto               readNoiseDn = DrawReadNoiseDn(settings, Width, Height);
  for (std::size_t pixel = 0; pixel < Width * Height; pixel += 37)
  {
    const double g = settings.camera.gainDnPerElectron * gain[pixel];
    const double offset = settings.camera.offsetDn + offsetDn[pixel];
    EXPECT_NEAR(OutputOf(readOut, pixel, 0.0, 0.0), offset, 1e-12);
    EXPECT_NEAR(OutputOf(readOut, pixel, 400.0, 0.0), offset + g * 400.0, 1e-11);
    EXPECT_NEAR(
      OutputOf(readOut, pixel, 400.0, 1.5), offset + g * 400.0 + 1.5 * gain[pixel] * readNoiseDn[pixel], 1e-11);
    EXPECT_NEAR(readOut.LocalGainAt(pixel, 400.0), g, 1e-14);
    EXPECT_NEAR(readOut.PixelOffsetDn(pixel), offset, 1e-12);
    EXPECT_NEAR(readOut.PixelReadNoiseDn(pixel), gain[pixel] * readNoiseDn[pixel], 1e-13);
  }
}

TEST(SensorNoiseReadOut, NonlinearOutputFollowsTheCurve)
{
  SimulationSettings settings = PatternedSettings();
  settings.flaws.response = { ResponseShape::Quadratic, 0.04, 800.0 };
  const ReadOut       readOut(settings, Width, Height);
  const ResponseCurve curve(settings.flaws.response);
  for (std::size_t pixel = 0; pixel < Width * Height; pixel += 37)
  {
    const double offset = OutputOf(readOut, pixel, 0.0, 0.0);
    const double full = OutputOf(readOut, pixel, 800.0, 0.0) - offset; // g_p S, for R(1) = 1
    for (const double electrons : { 100.0, 400.0, 790.0, 850.0 })
    {
      EXPECT_NEAR(OutputOf(readOut, pixel, electrons, 0.0) - offset, full * curve.Value(electrons / 800.0), 1e-10);
      const double difference =
        OutputOf(readOut, pixel, electrons + 0.01, 0.0) - OutputOf(readOut, pixel, electrons, 0.0);
      // One-sided difference: error h R'' / 2 = 0.01 * 2 * 0.04 / 800 / 2 of the gain.
      EXPECT_NEAR(difference / 0.01, readOut.LocalGainAt(pixel, electrons), 1e-5);
    }
    EXPECT_NEAR((OutputOf(readOut, pixel, 0.0, 1e-3) - offset) / 1e-3, readOut.PixelReadNoiseDn(pixel), 1e-3);
  }
}

TEST(SensorNoiseReadOut, LineNoiseIsAddedToTheOutput)
{
  SimulationSettings settings = PatternedSettings();
  const ReadOut      quiet(settings, Width, Height);
  settings.flaws.lineNoise = { 3.0, 2.0, 1.0, 20.0 };
  const ReadOut       noisy(settings, Width, Height);
  std::vector<double> expected(Width, 0.0);
  LineNoise(settings.flaws.lineNoise, settings.seed).AddTo(expected.data(), Width, 0, 3);
  for (std::size_t x = 0; x < Width; ++x)
  {
    const std::size_t pixel = 3 * Width + x;
    EXPECT_NEAR(OutputOf(noisy, pixel, 200.0, 0.5) - OutputOf(quiet, pixel, 200.0, 0.5), expected[x], 1e-11);
    EXPECT_EQ(noisy.PixelReadNoiseDn(pixel), quiet.PixelReadNoiseDn(pixel));
  }
}

TEST(SensorNoiseReadOut, SummaryIsThatOfThePixels)
{
  const ReadOut       readOut(PatternedSettings(), Width, Height);
  std::vector<double> noiseDn(Width * Height);
  double              squares = 0.0;
  for (std::size_t pixel = 0; pixel < noiseDn.size(); ++pixel)
  {
    noiseDn[pixel] = readOut.PixelReadNoiseDn(pixel);
    squares += noiseDn[pixel] * noiseDn[pixel];
  }
  std::sort(noiseDn.begin(), noiseDn.end());
  const auto summary = readOut.SummariseReadNoise();
  EXPECT_NEAR(summary.rmsDn, std::sqrt(squares / static_cast<double>(noiseDn.size())), 1e-12);
  EXPECT_NEAR(summary.medianDn, 0.5 * (noiseDn[noiseDn.size() / 2 - 1] + noiseDn[noiseDn.size() / 2]), 1e-12);
  EXPECT_GT(summary.rmsDn, 1.2 * summary.medianDn); // 2 % hot pixels of 10 sigma alone add 100 % in square
  // Without a pattern both are the camera's own.
  const auto plain = ReadOut(StaticSettings('A', 1), Width, Height).SummariseReadNoise();
  EXPECT_EQ(plain.rmsDn, 15.0);
  EXPECT_EQ(plain.medianDn, 15.0);
}

TEST(SensorNoiseReadOut, GammaInTheDarkHasTheMomentsOfItsOutput)
{
  SimulationSettings settings = StaticSettings('B', 1);
  settings.isDark = true;
  settings.flaws.response = { ResponseShape::Gamma, 2.2 };
  const StackSimulator simulator(std::vector<double>(40000, 1.0), 200, 200, settings);
  const Moments        found = MomentsOf(RenderAll<double>(simulator));
  const double         sd = simulator.PixelReadNoiseDn(0);
  EXPECT_NEAR(found.mean, simulator.PixelOffsetDn(0), 5.0 * sd / std::sqrt(found.count));
  EXPECT_NEAR(std::sqrt(found.variance), sd, 5.0 * sd / std::sqrt(2.0 * found.count));
  EXPECT_GT(simulator.PixelOffsetDn(0), settings.camera.offsetDn + 50.0);
}
