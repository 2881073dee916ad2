// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "helpers/SimulatorTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::simulator;

// Flaws that mix rows or frames, dark frames, and what stays as it was without them.

namespace
{
constexpr std::size_t Width = 48;
constexpr std::size_t Height = 40;

/** Everything that mixes rows or frames, on a small flickering stack. */
SimulationSettings
MixedSettings()
{
  SimulationSettings settings = FlickeringSettings(6);
  settings.flaws.brighterFatter.perElectron = 2e-6;
  settings.flaws.coupling.fraction = 0.01;
  settings.flaws.defectCorrection.thresholdSd = 3.0;
  settings.flaws.temporalFilter.weight = 0.4;
  settings.flaws.median.radiusPixels = 1;
  settings.flaws.smoothing.sdPixels = 0.5;
  settings.flaws.binning.factor = 2;
  settings.flaws.resampling = { 0.5, 0.25 };
  settings.flaws.blocks.quality = 95;
  settings.flaws.repetition.count = 2;
  return settings;
}

template <typename TPixel>
std::vector<TPixel>
FrameOf(const StackSimulator & simulator, std::size_t frame, const ParallelFor & parallelFor = SerialFor)
{
  std::vector<TPixel> pixels(simulator.GetWidth() * simulator.GetHeight());
  simulator.RenderFrame(frame, pixels.data(), parallelFor);
  return pixels;
}

StackSimulator
MakeSimulator(const SimulationSettings & settings)
{
  return StackSimulator(MakeTargetScene(Width, Height), Width, Height, settings);
}

/** Returns the FNV-1a hash of whole digital numbers. */
std::uint64_t
HashOf(const std::vector<double> & greyValues)
{
  std::uint64_t hash = 1469598103934665603ULL;
  for (const double greyValue : greyValues)
  {
    hash = (hash ^ static_cast<std::uint64_t>(greyValue)) * 1099511628211ULL;
  }
  return hash;
}
} // namespace

TEST(SensorNoiseSimulatorFrames, AFrameIsItsRowsWhereRowsStandAlone)
{
  SimulationSettings settings = FlickeringSettings(3);
  settings.flaws.lineNoise = { 3.0, 2.0, 1.0, 20.0 };
  settings.flaws.companding.bits = 8;
  settings.flaws.repetition.count = 2;
  const StackSimulator simulator = MakeSimulator(settings);
  EXPECT_FALSE(simulator.NeedsWholeFrames());
  std::vector<double> frames;
  for (std::size_t frame = 0; frame < 3; ++frame)
  {
    const auto pixels = FrameOf<std::uint16_t>(simulator, frame, Threads(3));
    frames.insert(frames.end(), pixels.begin(), pixels.end());
  }
  EXPECT_EQ(frames, RenderAll<std::uint16_t>(simulator));
}

TEST(SensorNoiseSimulatorFrames, AnyOrderAndNumberOfThreadsGiveTheSameBits)
{
  const StackSimulator                    inOrder = MakeSimulator(MixedSettings());
  std::vector<std::vector<std::uint16_t>> expected;
  for (std::size_t frame = 0; frame < 6; ++frame)
  {
    expected.push_back(FrameOf<std::uint16_t>(inOrder, frame));
  }
  const StackSimulator simulator = MakeSimulator(MixedSettings());
  for (const std::size_t frame : { 5, 0, 3, 2, 4, 1, 1 })
  {
    EXPECT_EQ(FrameOf<std::uint16_t>(simulator, frame, Threads(3)), expected[frame]) << frame;
  }
}

TEST(SensorNoiseSimulatorFrames, RowsThatNeedOthersAreRefused)
{
  std::vector<std::uint16_t> row(Width);
  const auto                 needsFrames = [&](const std::function<void(SensorFlaws &)> & change) {
    SimulationSettings settings = FlickeringSettings(2);
    change(settings.flaws);
    const StackSimulator simulator = MakeSimulator(settings);
    EXPECT_THROW(simulator.RenderRow(0, 0, row.data()), std::invalid_argument);
    return simulator.NeedsWholeFrames();
  };
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.coupling.fraction = 0.01; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.brighterFatter.perElectron = 1e-6; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.median.radiusPixels = 1; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.binning.factor = 2; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.blocks.quality = 95; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.smoothing.sdPixels = 0.6; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.resampling.shiftYPixels = 0.5; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.temporalFilter.weight = 0.5; }));
  EXPECT_TRUE(needsFrames([](SensorFlaws & flaws) { flaws.defectCorrection.thresholdSd = 3.0; }));
  SimulationSettings settings = MixedSettings();
  settings.frames = 5; // frame 5 would repeat frame 4
  EXPECT_THROW(FrameOf<std::uint16_t>(MakeSimulator(settings), 5), std::invalid_argument);
}

TEST(SensorNoiseSimulatorFrames, RepeatedFramesAreEqualInGreyValuesAndTruth)
{
  for (const bool isMixed : { false, true })
  {
    SimulationSettings settings = isMixed ? MixedSettings() : FlickeringSettings(6);
    settings.flaws.repetition.count = 3;
    const StackSimulator simulator = MakeSimulator(settings);
    EXPECT_EQ(FrameOf<double>(simulator, 0), FrameOf<double>(simulator, 2));
    EXPECT_EQ(FrameOf<double>(simulator, 3), FrameOf<double>(simulator, 5));
    EXPECT_NE(FrameOf<double>(simulator, 2), FrameOf<double>(simulator, 3));
    const auto & gamma = simulator.GetTruth().series.gamma;
    EXPECT_EQ(gamma[3], gamma[5]);
    EXPECT_NE(gamma[2], gamma[3]);
    // The exposures are the exposures of the stack without repetition.
    SimulationSettings once = settings;
    once.flaws.repetition.count = 1;
    EXPECT_EQ(FrameOf<double>(MakeSimulator(once), 1), FrameOf<double>(simulator, 3));
  }
}

TEST(SensorNoiseSimulatorFrames, EachThirdExposureMayBeRepeated)
{
  for (const bool isMixed : { false, true })
  {
    SimulationSettings settings = isMixed ? MixedSettings() : FlickeringSettings(6);
    settings.frames = 8;
    settings.flaws.repetition = { 1, 1 };
    const StackSimulator once = MakeSimulator(settings);
    settings.flaws.repetition = { 2, 3 };
    const StackSimulator           simulator = MakeSimulator(settings);
    const std::vector<std::size_t> exposures{ 0, 1, 2, 2, 3, 4, 5, 5 };
    for (std::size_t frame = 0; frame < 8; ++frame)
    {
      EXPECT_EQ(FrameOf<double>(simulator, frame), FrameOf<double>(once, exposures[frame])) << frame;
      EXPECT_EQ(simulator.GetTruth().series.gamma[frame], once.GetTruth().series.gamma[exposures[frame]]);
      EXPECT_EQ(settings.flaws.repetition.ExposureOf(settings.flaws.repetition.FirstFrameOf(frame)), frame);
    }
  }
  SimulationSettings settings;
  settings.flaws.repetition.period = 0;
  EXPECT_THROW(MakeSimulator(settings), std::invalid_argument);
}

TEST(SensorNoiseSimulatorFrames, TheCameraFiltersThenBinsThenMovesThenCompresses)
{
  SimulationSettings settings = StaticSettings('B', 1);
  settings.isDark = true;
  settings.camera.readNoiseDn = 100.0;
  const auto varianceWith = [&](const SensorFlaws & flaws) {
    settings.flaws = flaws;
    return MomentsOf(FrameOf<double>(StackSimulator(std::vector<double>(160000, 1.0), 400, 400, settings), 0)).variance;
  };
  SensorFlaws flaws;
  flaws.binning.factor = 2;
  EXPECT_NEAR(varianceWith(flaws), 2500.0, 5.0 * 2500.0 * std::sqrt(2.0 / 40000.0));
  // Within a square the half pixel changes nothing, between two it halves the variance: 3/4 of it stay.
  flaws.resampling.shiftXPixels = 0.5;
  EXPECT_NEAR(varianceWith(flaws), 0.75 * 2500.0, 5.0 * 2500.0 * std::sqrt(2.0 / 40000.0));
  // The blocks come last: all steps of quality 1 are 255 numbers of 8 bits, and no noise is left, nor an interpolation
  // of what differs between blocks.
  flaws.blocks.quality = 1;
  EXPECT_LT(varianceWith(flaws), 1e-6);
}

TEST(SensorNoiseSimulatorFrames, ChargeIsMovedBeforeReadNoiseAndOutputIsSmoothedAfterIt)
{
  // An even scene: shot noise g^2 A and read noise sigma^2.
  SimulationSettings settings = StaticSettings('B', 1);
  settings.camera = { 400.0, 2.0, 100.0, 30.0 };
  const auto varianceOf = [&] {
    const StackSimulator simulator(std::vector<double>(160000, 1.0), 400, 400, settings);
    return MomentsOf(FrameOf<double>(simulator, 0)).variance;
  };
  const double shot = 4.0 * 400.0;
  const double read = 900.0;
  const double error = 5.0 * (shot + read) * std::sqrt(2.0 / 160000.0);
  settings.flaws.coupling.fraction = 0.05;
  EXPECT_NEAR(varianceOf(), shot * (0.8 * 0.8 + 4.0 * 0.0025) + read, error);
  settings.flaws.coupling.fraction = 0.0;
  settings.flaws.resampling.shiftXPixels = 0.5;
  EXPECT_NEAR(varianceOf(), 0.5 * (shot + read), error);
}

TEST(SensorNoiseSimulatorFrames, DarkFramesHaveTheSamePatternsAndOtherNoise)
{
  SimulationSettings settings = FlickeringSettings(2);
  settings.dsnuSdDn = 20.0;
  settings.flaws.pattern.columnOffsetSdDn = 10.0;
  settings.flaws.readNoise.spread = 0.3;
  const StackSimulator bright = MakeSimulator(settings);
  settings.isDark = true;
  const StackSimulator dark = MakeSimulator(settings);
  std::vector<double>  electrons(Width, 1.0);
  dark.ExpectedElectronsRow(0, 20, electrons.data());
  EXPECT_EQ(electrons, std::vector<double>(Width, 0.0));
  double correlation = 0.0;
  double noise = 0.0;
  for (std::size_t pixel = 0; pixel < Width * Height; ++pixel)
  {
    ASSERT_EQ(dark.PixelOffsetDn(pixel), bright.PixelOffsetDn(pixel));
    ASSERT_EQ(dark.PixelReadNoiseDn(pixel), bright.PixelReadNoiseDn(pixel));
  }
  // The dark frames of a dark scene and of a closed shutter: same law, other numbers.
  settings.isDark = false;
  settings.camera.electrons = 1e-9;
  const auto open = FrameOf<double>(MakeSimulator(settings), 0);
  const auto closed = FrameOf<double>(dark, 0);
  for (std::size_t pixel = 0; pixel < Width * Height; ++pixel)
  {
    const double sd = dark.PixelReadNoiseDn(pixel);
    const double normal = (closed[pixel] - dark.PixelOffsetDn(pixel)) / sd;
    correlation += normal * (open[pixel] - dark.PixelOffsetDn(pixel)) / sd / (Width * Height);
    noise += normal * normal / (Width * Height);
  }
  EXPECT_NEAR(noise, 1.0, 5.0 * std::sqrt(2.0 / (Width * Height)));
  EXPECT_NEAR(correlation, 0.0, 5.0 / std::sqrt(Width * Height));
}

TEST(SensorNoiseSimulatorFrames, DarkNoiseIsNotThatOfDarkPixels)
{
  // A dark pixel draws its read noise first, as the first pixel of a dark row does.
  SimulationSettings  settings = StaticSettings('B', 2);
  std::vector<double> scene(20 * 20, 0.0);
  scene.back() = 1.0;
  const auto bright = FrameOf<double>(StackSimulator(scene, 20, 20, settings), 1);
  settings.isDark = true;
  const auto dark = FrameOf<double>(StackSimulator(scene, 20, 20, settings), 1);
  EXPECT_NE(bright[0], dark[0]);
}

TEST(SensorNoiseSimulatorFrames, WithoutFlawsTheGreyValuesEqualEarlierVersions)
{
  // Drawn before there were flaws to set. The last digit of log and exp may differ from platform to platform, which
  // changes one grey value in 1e12.
  const SimulationSettings plain = FlickeringSettings(3);
  EXPECT_EQ(HashOf(RenderAll<std::uint16_t>(MakeSimulator(plain))), 14289988999828458610ULL);
  SimulationSettings patterned = plain;
  patterned.prnuSd = 0.01;
  patterned.dsnuSdDn = 3.0;
  patterned.hotPixelFraction = 0.05;
  patterned.rollingShutterPeriodRows = 15.0;
  patterned.clipHighDn = 2500.0;
  EXPECT_EQ(HashOf(RenderAll<std::uint16_t>(MakeSimulator(patterned))), 4100142828553080770ULL);
}

TEST(SensorNoiseSimulatorFrames, LocalGainIsTakenAtTheMeanSignalOfThePixel)
{
  SimulationSettings settings = StaticSettings('A', 1);
  settings.flaws.response = { ResponseShape::Quadratic, 0.04, 1200.0 };
  const std::vector<double> flat(400, 1.0);
  // 600 e- are half of the full scale, where this curve has slope 1; in the dark it has 1.04.
  EXPECT_DOUBLE_EQ(StackSimulator(flat, 20, 20, settings).LocalGainAt(7), 5.0);
  settings.isDark = true;
  EXPECT_DOUBLE_EQ(StackSimulator(flat, 20, 20, settings).LocalGainAt(7), 5.0 * 1.04);
  settings.isDark = false;
  settings.flaws.response = {};
  settings.flaws.pattern.gainSd = 0.05;
  const StackSimulator simulator(flat, 20, 20, settings);
  std::vector<double>  gains;
  for (std::size_t pixel = 0; pixel < flat.size(); ++pixel)
  {
    gains.push_back(simulator.LocalGainAt(pixel));
  }
  EXPECT_NEAR(MomentsOf(gains).mean, 5.0, 1e-12);
  EXPECT_GT(MomentsOf(gains).variance, 0.0);
}
