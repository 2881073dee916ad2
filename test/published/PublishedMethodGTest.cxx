// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "simulation/Random.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "helpers/PublishedTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
template <typename TPixel>
Stack<TPixel>
ConstantStack(TPixel value, std::size_t frames = 20)
{
  return { 20, 16, frames, std::vector<TPixel>(20 * 16 * frames, value) };
}
} // namespace

TEST(SensorNoisePublishedMethod, RecoversTheCamera)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    SimulationSettings simulation = SettingsOf(0.1, 60);
    simulation.camera = PaperCamera(camera);
    const auto &   truth = simulation.camera;
    const auto     stack = Simulate(simulation, 96, 96);
    const auto     method = Measure(stack, WithGlobalShutter());
    const Report & report = method.GetReport();
    const double   pixels = static_cast<double>(report.pixels.used);
    const double   full = truth.electrons * truth.gainDnPerElectron; // largest signal [DN]
    // Levels k/15 of the full scale: sd 0.31, root mean square of the variance at most 0.6 (g full) + sigma^2 + 1/12.
    const double spread = 0.31 * full;
    const double noise = 0.6 * truth.gainDnPerElectron * full + truth.readNoiseDn * truth.readNoiseDn + 0.1;
    const double gainSd = std::sqrt(2.0 / 59.0) * noise / (spread * std::sqrt(pixels));
    // The vibration test prefers pixels of low variance: level -ln(level) 2 / (T-1) = 0.16 % of the variance.
    EXPECT_NEAR(ValueOf(report.gain) / truth.gainDnPerElectron, 1.0, 5.0 * gainSd / truth.gainDnPerElectron + 0.0016)
      << camera;
    // v_* and v^* average at least 30 pixels. sd(K) is their noise over the flicker, and d mu / d K = 1 + mu / full.
    const double darkNoise = (truth.readNoiseDn * truth.readNoiseDn + 0.1) / 30.0;
    const double brightNoise = truth.offsetDn * truth.offsetDn * truth.gainDnPerElectron / full / 30.0;
    const double offsetSd = std::sqrt((darkNoise + brightNoise) / 59.0) / 0.08 * (1.0 + truth.offsetDn / full);
    EXPECT_NEAR(ValueOf(report.offset), truth.offsetDn, 5.0 * offsetSd) << camera;
    const double flicker = DrawTruth(simulation, 96).realisedFlickerSd;
    EXPECT_NEAR(ValueOf(report.flickerSd), flicker, 0.02 * flicker) << camera; // offset and v^* within 1 % each
    // The term of each pixel has the variance 2 + 12/59; the noise of gamma_t, common to all pixels, adds at most 5 %.
    EXPECT_NEAR(*report.fit.reducedChi2, 1.0, 5.0 * std::sqrt(2.2 / pixels) + 0.05) << camera;
    EXPECT_EQ(report.bitDepth, 12) << camera;
    EXPECT_FALSE(HasWarning(report, WarningCode::CorrectedVarianceCurved)) << camera;
  }
}

TEST(SensorNoisePublishedMethod, WithoutFlickerOffsetAndReadNoiseAreNotIdentifiable)
{
  const auto     method = Measure(Simulate(SettingsOf(0.0, 40)), WithGlobalShutter());
  const Report & report = method.GetReport();
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 0.065); // sd sqrt(2/39) 1,700 / (900 sqrt(1,300 pixels)): 1.2 %; 5 of them
  EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(report.offset.value || report.readNoise.value);
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetNotIdentifiable));
  ASSERT_TRUE(report.offset.bracket && report.offset.bracket->high);
  EXPECT_GT(*report.offset.bracket->high, 100.0);
}

TEST(SensorNoisePublishedMethod, StrongFlickerAndLittleNoiseIdentifyTheOffset)
{
  SimulationSettings simulation = SettingsOf(0.15, 20);
  simulation.camera = { 1e5, 0.02, 100.0, 0.5 };
  for (simulation.seed = 1; simulation.seed <= 5; ++simulation.seed)
  {
    const auto method = Measure(Simulate(simulation), WithGlobalShutter());
    EXPECT_EQ(method.GetReport().offset.status, EstimateStatus::Identified) << simulation.seed;
  }
}

TEST(SensorNoisePublishedMethod, SaturatedPixelsAreFoundAndLeftOut)
{
  const auto     method = Measure(FlickeringStack().Map<GreyValue>([](int u) { return std::min(u, 2900); }));
  const Report & report = method.GetReport();
  EXPECT_EQ(report.clipHighDn, 2900.0);
  EXPECT_TRUE(HasWarning(report, WarningCode::ClipLevelFound));
  EXPECT_GT(report.pixels.clipped, 0u);
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 0.05);
}

TEST(SensorNoisePublishedMethod, StacksWithoutInformationFailWithAReason)
{
  const auto clipped = Measure(ConstantStack<unsigned char>(255));
  ExpectNothingMeasured(clipped.GetReport(), WarningCode::NothingToMeasure);
  EXPECT_EQ(clipped.GetReport().pixels.clipped, 320u);
  auto changing = ConstantStack<GreyValue>(700);
  for (std::size_t t = 0; t < changing.frames; ++t)
  {
    changing.pixels[t * 20 * 16] = static_cast<GreyValue>(700 + t); // otherwise all frames are equal
  }
  const auto constant = Measure(changing);
  ExpectNothingMeasured(constant.GetReport(), WarningCode::NothingToMeasure);
  EXPECT_EQ(constant.GetPixelUse()[30], static_cast<std::uint8_t>(PixelUse::Constant));
  EXPECT_EQ(constant.GetPixelUse()[5], static_cast<std::uint8_t>(PixelUse::Border));
  const auto nan = Measure(ConstantStack<float>(std::numeric_limits<float>::quiet_NaN()));
  ExpectNothingMeasured(nan.GetReport(), WarningCode::NothingToMeasure);
  EXPECT_EQ(nan.GetReport().pixels.notFinite, 320u);
  EXPECT_TRUE(nan.GetCorrectedVariance().empty());
  auto              repeated = FlickeringStack();
  const std::size_t pixels = repeated.width * repeated.height;
  for (std::size_t i = pixels; i < repeated.pixels.size(); ++i)
  {
    repeated.pixels[i] = i % pixels == 0 ? static_cast<GreyValue>(i / pixels) : repeated.pixels[i % pixels];
  }
  ExpectNothingMeasured(Measure(repeated).GetReport(), WarningCode::NothingToMeasure);
}

TEST(SensorNoisePublishedMethod, OneIntensityIsTooSmallARange)
{
  auto                stack = ConstantStack<float>(0.0F, 40);
  CounterSeededRandom random(3);
  std::generate(
    stack.pixels.begin(), stack.pixels.end(), [&] { return static_cast<float>(500.0 + 20.0 * random.Normal()); });
  const auto method = Measure(stack);
  EXPECT_EQ(method.GetReport().gain.status, EstimateStatus::NotIdentifiable);
  EXPECT_TRUE(HasWarning(method.GetReport(), WarningCode::IntensityRangeTooSmall));
}

TEST(SensorNoisePublishedMethod, WrongUseIsRefused)
{
  using Method = PublishedMethod<GreyValue>;
  const FrameGeometry geometry{ 20, 16, 1 };
  EXPECT_THROW(Method({}, geometry, 4), std::invalid_argument);
  EXPECT_NO_THROW(Method({}, geometry, 5));
  EXPECT_THROW(Method({}, { 2, 2, 1 }, 20), std::invalid_argument);
  EXPECT_THROW(Method({}, geometry, 20, std::vector<std::uint8_t>(319, 1)), std::invalid_argument);
  PublishedSettings settings;
  settings.level = 0.0;
  EXPECT_THROW(Method(settings, geometry, 20), std::invalid_argument);
  settings = {};
  settings.brightQuantile = 0.005;
  EXPECT_THROW(Method(settings, geometry, 20), std::invalid_argument);
  settings = {};
  settings.dnSettings.bitDepth = 10;
  EXPECT_THROW(Measure(FlickeringStack(), settings), std::invalid_argument); // the data exceed 1,023
}

TEST(SensorNoisePublishedMethod, PassOfWrongLengthIsRefused)
{
  const auto                 stack = ConstantStack<GreyValue>(700);
  PublishedMethod<GreyValue> shortPass({}, { 20, 16, 1 }, 20);
  shortPass.AddFrames(stack.pixels.data(), 19);
  EXPECT_THROW(shortPass.EndPass(), std::logic_error);
  for (unsigned int pass = 0; pass < 3; ++pass)
  {
    PublishedMethod<GreyValue> longPass({}, { 20, 16, 1 }, 19);
    for (unsigned int before = 0; before < pass; ++before)
    {
      longPass.AddFrames(stack.pixels.data(), 19);
      longPass.EndPass();
    }
    longPass.AddFrames(stack.pixels.data(), 10);
    EXPECT_THROW(longPass.AddFrames(stack.pixels.data(), 10), std::logic_error) << pass;
  }
}
