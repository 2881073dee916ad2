// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SimulatorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

namespace
{
std::vector<double>
Ramp(std::size_t width, std::size_t height, double perColumn, double perRow)
{
  std::vector<double> image(width * height);
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    image[i] = perColumn * static_cast<double>(i % width) + perRow * static_cast<double>(i / width);
  }
  return image;
}

/** A constant scene has mean g A + mu and variance g mean + sigma^2 - g mu = g^2 A + sigma^2 (Sur and Grediac (2.20),
 * all still), and 1/12 more if it is rounded to whole DN. */
template <typename TPixel>
void
CheckNoiseOfConstantScene(char camera, double roundingVariance)
{
  SCOPED_TRACE(camera);
  const CameraModel    model = PaperCamera(camera);
  const StackSimulator simulator(std::vector<double>(1024, 0.5), 32, 32, StaticSettings(camera, 400));
  const Moments        found = MomentsOf(RenderAll<TPixel>(simulator));
  const double         g = model.gainDnPerElectron;
  const double         mean = g * model.electrons + model.offsetDn;
  const double variance = g * mean + model.readNoiseDn * model.readNoiseDn - g * model.offsetDn + roundingVariance;
  // Fourth central moment: the moment of a normal law, 3 V^2, and the Poisson law's excess g^4 A. 5 standard errors.
  const double varianceOfVariance = (2.0 * variance * variance + std::pow(g, 4) * model.electrons) / found.count;
  EXPECT_NEAR(found.mean, mean, 5.0 * std::sqrt(variance / found.count));
  EXPECT_NEAR(found.variance, variance, 5.0 * std::sqrt(varianceOfVariance));
}

std::string
ErrorOf(const std::function<void(SimulationSettings &)> & change)
{
  SimulationSettings settings;
  change(settings);
  try
  {
    const StackSimulator      simulator(MakeBarsScene(16, 2), 16, 2, settings);
    std::vector<std::uint8_t> row(16);
    simulator.RenderRow(0, 0, row.data());
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "no error";
}
} // namespace

TEST(SensorNoiseSimulator, ConstantSceneHasTheVarianceOfTheModel)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    CheckNoiseOfConstantScene<double>(camera, 0.0);
    CheckNoiseOfConstantScene<std::uint16_t>(camera, 1.0 / 12.0);
  }
}

TEST(SensorNoiseSimulator, ShiftOfALinearRampIsExact)
{
  constexpr std::size_t size = 40;
  SimulationSettings    settings = StaticSettings('B', 20);
  settings.opticalBlurPixels = 0.0;
  settings.conditions = { 0.1, 1.5, 0.7 };
  const StackSimulator simulator(Ramp(size, size, 2.0, 3.0), size, size, settings);
  const double         perUnit = settings.camera.electrons / (5.0 * (size - 1));
  std::vector<double>  electrons(size);
  for (std::size_t frame = 0; frame < settings.frames; ++frame)
  {
    const SimulatedSeries & series = simulator.GetTruth().series;
    ASSERT_LT(std::abs(series.alpha[frame]) + std::abs(series.beta[frame]), 9.0); // stays off the edges below
    for (std::size_t y = 10; y < size - 10; ++y)
    {
      simulator.ExpectedElectronsRow(frame, y, electrons.data());
      for (std::size_t x = 10; x < size - 10; ++x)
      {
        const double scene = perUnit * (2.0 * (static_cast<double>(x) + series.alpha[frame]) +
                                        3.0 * (static_cast<double>(y) + series.beta[frame]));
        EXPECT_NEAR(electrons[x], (1.0 + series.gamma[frame]) * scene, 1e-9); // rounding, 1e-16 of 3000, many times
      }
    }
  }
}

TEST(SensorNoiseSimulator, EdgePixelsAreReplicated)
{
  SimulationSettings settings = StaticSettings('B', 50);
  settings.opticalBlurPixels = 0.0;
  settings.conditions.vibrationSdXPixels = 1e6;
  const StackSimulator simulator(Ramp(4, 1, 1.0, 0.0), 4, 1, settings);
  std::vector<double>  electrons(4);
  for (std::size_t frame = 0; frame < settings.frames; ++frame)
  {
    simulator.ExpectedElectronsRow(frame, 0, electrons.data());
    const double edge = simulator.GetTruth().series.alpha[frame] > 0.0 ? 3000.0 : 0.0;
    EXPECT_EQ(electrons, std::vector<double>(4, edge)) << simulator.GetTruth().series.alpha[frame];
  }
}

TEST(SensorNoiseSimulator, ReferenceIsBlurredAndThenScaled)
{
  std::vector<double> point(81, 7.0);
  point[40] = 9.0;
  const StackSimulator simulator(point, 9, 9, StaticSettings('B', 1));
  std::vector<double>  electrons(9);
  simulator.ExpectedElectronsRow(0, 4, electrons.data());
  EXPECT_NEAR(electrons[0], 0.0, 1e-9); // rounding, 1e-16 of 3000, many times
  EXPECT_NEAR(electrons[4], 3000.0, 1e-9);
  EXPECT_NEAR(electrons[5], 3000.0 * std::exp(-2.0), 1e-9); // exp(-d^2 / (2 * 0.5^2))
}

TEST(SensorNoiseSimulator, NegativeRatesCountAsZero)
{
  SimulationSettings settings = StaticSettings('B', 200);
  settings.conditions.flickerSd = 2.0;
  settings.camera.readNoiseDn = 0.0;
  const StackSimulator simulator(std::vector<double>(4, 1.0), 2, 2, settings);
  double               row[2];
  std::size_t          dark = 0;
  for (std::size_t frame = 0; frame < settings.frames; ++frame)
  {
    simulator.RenderRow(frame, 0, row);
    const bool isDark = simulator.GetTruth().series.gamma[frame] <= -1.0;
    EXPECT_EQ(row[0] == 100.0, isDark) << frame;
    dark += isDark ? 1 : 0;
  }
  EXPECT_GT(dark, 0u);
}

TEST(SensorNoiseSimulator, RowsAreAPureFunctionOfFrameAndRow)
{
  SimulationSettings settings;
  settings.frames = 5;
  settings.prnuSd = 0.01;
  const auto           scene = MakeBarsScene(32, 8);
  const StackSimulator simulator(scene, 32, 8, settings);
  std::vector<double>  first(32);
  std::vector<double>  again(32);
  simulator.RenderRow(3, 6, first.data());
  simulator.RenderRow(0, 0, again.data());
  EXPECT_NE(first, again);
  simulator.RenderRow(3, 6, again.data());
  EXPECT_EQ(first, again);

  // A longer stack begins with the shorter one; another seed gives another stack.
  settings.frames = 50;
  StackSimulator(scene, 32, 8, settings).RenderRow(3, 6, again.data());
  EXPECT_EQ(first, again);
  settings.seed = 2;
  StackSimulator(scene, 32, 8, settings).RenderRow(3, 6, again.data());
  EXPECT_NE(first, again);
}

TEST(SensorNoiseSimulator, PublishedSeedsKeepTheirGreyValues)
{
  // Written down from the first version: whoever quotes a seed can count on the stack.
  const StackSimulator       simulator(MakeBarsScene(16, 4), 16, 4, SimulationSettings{});
  std::vector<std::uint16_t> row(16);
  simulator.RenderRow(1, 2, row.data());
  EXPECT_EQ(row,
            (std::vector<std::uint16_t>{
              1325, 1785, 2672, 2910, 1991, 791, 302, 361, 107, 1923, 426, 1551, 3001, 1441, 2325, 3211 }));
}

TEST(SensorNoiseSimulator, RealisedStandardDeviationsAreThoseOfTheSeries)
{
  SimulationSettings settings;
  settings.conditions = PaperConditions(1);
  settings.frames = 60;
  const SimulationTruth truth = DrawTruth(settings, 10);
  std::vector<double>   brightness;
  double                sum = 0.0;
  for (const double gamma : truth.series.gamma)
  {
    sum += 1.0 + gamma;
  }
  for (std::size_t t = 0; t < 60; ++t)
  {
    brightness.push_back((1.0 + truth.series.gamma[t]) / (sum / 60.0));
    EXPECT_NEAR(truth.normalisedFlicker[t], brightness[t] - 1.0, 1e-14); // rounding of a sum of 60
  }
  EXPECT_NEAR(truth.realisedFlickerSd, std::sqrt(MomentsOf(brightness).variance), 1e-14);
  EXPECT_NEAR(truth.realisedVibrationSdXPixels, std::sqrt(MomentsOf(truth.series.alpha).variance), 1e-14);
  EXPECT_NEAR(truth.realisedVibrationSdYPixels, std::sqrt(MomentsOf(truth.series.beta).variance), 1e-14);
  // The relative standard error of a standard deviation is 1/sqrt(2 (T - 1)) = 9 %: 5 of them.
  EXPECT_NEAR(truth.realisedVibrationSdXPixels, 0.3, 0.3 * 5.0 / std::sqrt(2.0 * 59.0));
  EXPECT_NEAR(truth.realisedVibrationSdYPixels, 0.2, 0.2 * 5.0 / std::sqrt(2.0 * 59.0));
  settings.frames = 1;
  EXPECT_TRUE(std::isnan(DrawTruth(settings, 10).realisedFlickerSd));
}

TEST(SensorNoiseSimulator, ErrorsNameWhatWasFoundAndWhatWasExpected)
{
  using S = SimulationSettings;
  EXPECT_EQ(ErrorOf([](S & s) { s.bitDepth = 8; }), "no error");
  EXPECT_EQ(ErrorOf([](S & s) { s.bitDepth = 12; }), "the bit depth is 12; the pixel type holds at most 8 bits");
  EXPECT_EQ(ErrorOf([](S & s) { s.frames = 0; }), "the number of frames is 0; expected at least 1");
  EXPECT_EQ(ErrorOf([](S & s) { s.camera.gainDnPerElectron = 0.0; }),
            "the gain is 0; expected a number above 0, at most 1e9");
  EXPECT_EQ(ErrorOf([](S & s) { s.conditions.flickerSd = -1.0; }),
            "the flicker standard deviation is -1; expected 0 to 1e9");
  EXPECT_EQ(ErrorOf([](S & s) {
              s.clipLowDn = 5.0;
              s.clipHighDn = 5.0;
            }),
            "the clip levels are 5 and 5; expected the low one below the high one");
  EXPECT_EQ(ErrorOf([](S & s) {
              s.bitDepth = 8;
              s.clipLowDn = 300.0;
            }),
            "the clip levels leave the digital numbers from 300 to 255; expected at least two digital numbers");
  for (const auto & change :
       std::vector<std::function<void(S &)>>{ [](S & s) { s.camera.electrons = 2e9; },
                                              [](S & s) { s.camera.offsetDn = NAN; },
                                              [](S & s) { s.camera.readNoiseDn = -1.0; },
                                              [](S & s) { s.conditions.vibrationSdXPixels = NAN; },
                                              [](S & s) { s.conditions.vibrationSdYPixels = -1; },
                                              [](S & s) { s.bitDepth = 33; },
                                              [](S & s) { s.opticalBlurPixels = -1.0; },
                                              [](S & s) { s.rollingShutterPeriodRows = -1.0; },
                                              [](S & s) { s.prnuSd = -1.0; },
                                              [](S & s) { s.dsnuSdDn = INFINITY; },
                                              [](S & s) { s.hotPixelFraction = 1.1; },
                                              [](S & s) { s.hotPixelNoiseFactor = -1.0; } })
  {
    EXPECT_NE(ErrorOf([&change](S & s) {
                s.bitDepth = 8;
                change(s);
              }),
              "no error");
  }
  EXPECT_THROW(PaperCamera('D'), std::invalid_argument);
  EXPECT_THROW(PaperConditions(4), std::invalid_argument);
  EXPECT_THROW(StackSimulator({ 1.0, 2.0 }, 3, 1, S{}), std::invalid_argument);
  EXPECT_THROW(StackSimulator({}, 0, 0, S{}), std::invalid_argument);
  EXPECT_THROW(StackSimulator({ 1.0, NAN }, 2, 1, S{}), std::invalid_argument);
  const StackSimulator simulator({ 1.0, 2.0 }, 2, 1, S{});
  double               row[2];
  EXPECT_THROW(simulator.RenderRow(100, 0, row), std::invalid_argument);
  EXPECT_THROW(simulator.RenderRow(0, 1, row), std::invalid_argument);
}
