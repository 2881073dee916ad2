// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SimulatorTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

// Effects of real sensors beyond the model: rolling shutter, clipping, fixed patterns.

TEST(SensorNoiseSimulator, RollingShutterFlickersWithItsPeriod)
{
  constexpr std::size_t height = 60;
  SimulationSettings    settings = StaticSettings('B', 400);
  settings.conditions.flickerSd = 0.05;
  settings.rollingShutterPeriodRows = 20.0;
  const StackSimulator    simulator(std::vector<double>(height, 1.0), 1, height, settings);
  const SimulationTruth & truth = simulator.GetTruth();
  for (std::size_t frame = 0; frame < 5; ++frame)
  {
    double sumOfSquares = 0.0;
    for (std::size_t y = 0; y < height; ++y)
    {
      double electrons = 0.0;
      simulator.ExpectedElectronsRow(frame, y, &electrons);
      const double gamma = electrons / 3000.0 - 1.0;
      EXPECT_NEAR(gamma, FlickerOfRow(settings, truth.series, frame, y), 1e-13); // rounding of 3000 (1 + gamma)
      EXPECT_NEAR(gamma, FlickerOfRow(settings, truth.series, frame, (y + 20) % height), 1e-13);
      EXPECT_NEAR(gamma, -FlickerOfRow(settings, truth.series, frame, (y + 10) % height), 1e-13);
      sumOfSquares += gamma * gamma;
    }
    // Over whole periods a sine of amplitude sqrt(2) s has mean 0 and mean square s^2.
    EXPECT_NEAR(sumOfSquares / height, 0.05 * 0.05, 1e-13);
    EXPECT_NEAR(truth.series.gamma[frame], 0.0, 1e-13);
  }
  // 2 sin^2 of a uniform phase has variance 1/2, so the relative standard error of s is sqrt(1/2)/(2 sqrt T): 5 of
  // them.
  EXPECT_NEAR(truth.realisedFlickerSd, 0.05, 0.05 * 5.0 * std::sqrt(0.5 / 400.0) / 2.0);
}

TEST(SensorNoiseSimulator, IntegerPixelsAreClippedToTheBitDepthAndTheSensorsLevels)
{
  SimulationSettings settings = StaticSettings('B', 20);
  settings.bitDepth = 8;
  settings.camera.offsetDn = 0.0;
  const auto scene = MakeBarsScene(64, 16);
  auto       values = RenderAll<std::uint16_t>(StackSimulator(scene, 64, 16, settings));
  EXPECT_EQ(*std::min_element(values.begin(), values.end()), 0.0);
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), 255.0);
  // The clip levels of the sensor are within the DN range, or are cut to it.
  settings.bitDepth = 12;
  settings.clipLowDn = 17.5;
  settings.clipHighDn = 2400.5;
  values = RenderAll<std::uint16_t>(StackSimulator(scene, 64, 16, settings));
  EXPECT_EQ(*std::min_element(values.begin(), values.end()), 18.0);
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), 2400.0);
  EXPECT_EQ(StackSimulator::PixelRangeDn<std::uint16_t>(settings), std::make_pair(18.0, 2400.0));
  settings.clipHighDn = 1e6;
  EXPECT_EQ(StackSimulator::PixelRangeDn<std::uint16_t>(settings), std::make_pair(18.0, 4095.0));
  // No bit depth: the range of the type.
  settings = StaticSettings('B', 1);
  settings.bitDepth = 0;
  EXPECT_EQ(StackSimulator::PixelRangeDn<std::int16_t>(settings), std::make_pair(-32768.0, 32767.0));
}

TEST(SensorNoiseSimulator, FloatingPixelsAreClippedAtGivenLevelsOnly)
{
  SimulationSettings settings = StaticSettings('B', 20);
  settings.camera.offsetDn = 0.0;
  settings.camera.electrons = 10000.0;
  const auto scene = MakeBarsScene(64, 16);
  auto       values = RenderAll<float>(StackSimulator(scene, 64, 16, settings));
  EXPECT_LT(*std::min_element(values.begin(), values.end()), 0.0);
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 4095.0);
  EXPECT_TRUE(std::any_of(values.begin(), values.end(), [](double v) { return v != std::floor(v); }));
  settings.clipLowDn = 2.5;
  settings.clipHighDn = 900.5;
  values = RenderAll<float>(StackSimulator(scene, 64, 16, settings));
  EXPECT_EQ(*std::min_element(values.begin(), values.end()), 2.5);
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), 900.5);
}

TEST(SensorNoiseSimulator, FixedPatternsHaveTheirStandardDeviationAndStayFromFrameToFrame)
{
  constexpr std::size_t size = 100;
  SimulationSettings    settings = StaticSettings('B', 2);
  settings.prnuSd = 0.02;
  const std::vector<double> flat(size * size, 1.0);
  StackSimulator            simulator(flat, size, size, settings);
  std::vector<double>       electrons(size * size);
  std::vector<double>       later(size * size);
  for (std::size_t y = 0; y < size; ++y)
  {
    simulator.ExpectedElectronsRow(0, y, electrons.data() + y * size);
    simulator.ExpectedElectronsRow(1, y, later.data() + y * size);
  }
  EXPECT_EQ(electrons, later);
  // 5 standard errors of a standard deviation, relative 1/sqrt(2 n).
  const double error = 5.0 / std::sqrt(2.0 * size * size);
  EXPECT_NEAR(std::sqrt(MomentsOf(electrons).variance), 3000.0 * 0.02, 3000.0 * 0.02 * error);

  settings.prnuSd = 0.0;
  settings.dsnuSdDn = 40.0;
  settings.camera = { 1e-9, 1.0, 100.0, 0.0 }; // no signal and no read noise: the offsets alone
  const auto offsets = RenderAll<double>(StackSimulator(flat, size, size, settings));
  EXPECT_TRUE(std::equal(offsets.begin(), offsets.begin() + size * size, offsets.begin() + size * size));
  EXPECT_NEAR(std::sqrt(MomentsOf(offsets).variance), 40.0, 40.0 * error);
}

TEST(SensorNoiseSimulator, HotPixelsHaveExcessReadNoise)
{
  SimulationSettings settings = StaticSettings('B', 1);
  settings.camera.electrons = 1e-9;
  settings.hotPixelFraction = 0.01;
  const auto   values = RenderAll<double>(StackSimulator(std::vector<double>(250000, 1.0), 500, 500, settings));
  const double beyond = static_cast<double>(
    std::count_if(values.begin(), values.end(), [](double v) { return std::abs(v - 100.0) > 80.0; }));
  // 1 % of the pixels have ten times 8 DN; 10 sigma of the others is out of reach; erfc(1/sqrt 2) = 31.7 % of them
  // pass.
  const double expected = 250000.0 * 0.01 * 0.3173;
  EXPECT_NEAR(beyond, expected, 5.0 * std::sqrt(expected)); // a count of rare events: 5 standard deviations
}
