// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "simulation/Random.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SensorTestHelper.h"
#include "helpers/SentencesTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <regex>
#include <string>
#include <vector>

// Causes of the warnings of the refined method; without the cause the same stack gives no warning.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 128;
constexpr std::size_t Frames = 40;

/** Returns a value as a digital number. */
GreyValue
GreyValueOf(double value)
{
  return static_cast<GreyValue>(std::clamp(std::lround(value), 0L, 65535L));
}

/** Returns a stack of the target, with the values of the pixels replaced by \a change. */
Stack<GreyValue>
Changed(const std::function<double(std::size_t t, std::size_t x, std::size_t y, double value)> & change,
        const SimulationSettings & settings = StaticCamera(Frames))
{
  Stack<GreyValue> stack = Simulate<GreyValue>(settings, Size, Size);
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    const std::size_t p = i % (Size * Size);
    stack.pixels[i] = GreyValueOf(change(i / (Size * Size), p % Size, p / Size, stack.pixels[i]));
  }
  return stack;
}

void
ExpectWarns(const Stack<GreyValue> & stack, WarningCode code)
{
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_TRUE(HasWarning(report, code)) << KindOf(code).name << '\n' << MakeText(report);
  for (const Warning & warning : report.warnings)
  {
    EXPECT_LE(WordsOfLongestSentence(warning.message), MostWords) << warning.message;
    EXPECT_TRUE(HasAction(warning)) << warning.message;
  }
  const bool isMeasured = report.gain.status == EstimateStatus::Identified;
  EXPECT_EQ(isMeasured, KindOf(code).severity != Severity::Error) << KindOf(code).name;
  if (isMeasured)
  {
    EXPECT_NEAR(*report.gain.value, 1.0, 5.0 * *report.gain.standardError) << KindOf(code).name;
  }
}
} // namespace

TEST(SensorNoiseRefinedWarnings, PlainStackHasNone)
{
  const Report report = Measure(Simulate<GreyValue>(StaticCamera(Frames), Size, Size), {}).GetReport();
  EXPECT_TRUE(report.warnings.empty()) << MakeText(report);
}

TEST(SensorNoiseRefinedWarnings, IrregularCodes)
{
  // Every digital number times 2.6: the distances are 2 or 3.
  const Stack<GreyValue> stack = Changed([](auto, auto, auto, double u) { return 2.6 * u; });
  EXPECT_TRUE(HasWarning(Measure(stack, {}).GetReport(), WarningCode::IrregularCodes));
}

TEST(SensorNoiseRefinedWarnings, NotStatic)
{
  ExpectWarns(Changed([](std::size_t t, std::size_t x, std::size_t y, double u) {
                const bool isThere = y > 80 && x > 2 * t && x < 2 * t + 30;
                return isThere ? 0.5 * (u + 100.0) : u;
              }),
              WarningCode::NotStatic);
}

TEST(SensorNoiseRefinedWarnings, NotStaticNamesTheLevelsOnBothSides)
{
  // A square, brighter than all else by 3000 DN, flickers by itself. Its dark surroundings are left out with it.
  const Stack<GreyValue> stack = Changed([](std::size_t t, std::size_t x, std::size_t y, double u) {
    const bool isThere = x > 20 && x < 60 && y > 20 && y < 60;
    return isThere ? u + 3000.0 * (1.0 + 0.2 * std::sin(1.0 + static_cast<double>(t * t))) : u;
  });
  const Report           report = Measure(stack, {}).GetReport();
  const auto warning = std::find_if(report.warnings.begin(), report.warnings.end(), [](const Warning & own) {
    return own.code == WarningCode::NotStatic;
  });
  ASSERT_NE(warning, report.warnings.end()) << MakeText(report);
  const std::regex ranges("them have ([0-9.]+) to ([0-9.]+) DN; of the pixels used, ([0-9.]+) to ([0-9.]+) DN");
  std::smatch      found;
  ASSERT_TRUE(std::regex_search(warning->message, found, ranges)) << warning->message;
  EXPECT_LT(std::stod(found[1]), std::stod(found[2])) << warning->message;
  EXPECT_LT(std::stod(found[3]), std::stod(found[4])) << warning->message;
  EXPECT_GT(std::stod(found[2]), std::stod(found[4])) << warning->message;
}

TEST(SensorNoiseRefinedWarnings, NoisyPixels)
{
  SimulationSettings settings = StaticCamera(Frames);
  settings.hotPixelFraction = 0.01;
  ExpectWarns(Simulate<GreyValue>(settings, Size, Size), WarningCode::NoisyPixels);
}

TEST(SensorNoiseRefinedWarnings, LocalLight)
{
  // A second lamp illuminates the right half.
  ExpectWarns(Changed([](std::size_t t, std::size_t x, auto, double u) {
                const double gamma = 0.05 * std::sin(2.3 * static_cast<double>(t));
                return u + (x > Size / 2 ? gamma * (u - 100.0) : 0.0);
              }),
              WarningCode::LocalLight);
}

TEST(SensorNoiseRefinedWarnings, OffsetDrift)
{
  ExpectWarns(Changed([](std::size_t t, auto, auto, double u) { return u + 1.0 * static_cast<double>(t); }),
              WarningCode::OffsetDrift);
}

TEST(SensorNoiseRefinedWarnings, OffsetThatWandersIsNoFlicker)
{
  // The level of every frame changes by up to 3 DN, at dark and at bright pixels alike.
  const auto wander = [](std::size_t t, auto, auto, double u) {
    return u + 3.0 * std::sin(2.3 * static_cast<double>(t));
  };
  SimulationSettings settings = StaticCamera(Frames);
  settings.conditions.flickerSd = 0.0;
  const Report steady = Measure(Changed(wander, settings), {}).GetReport();
  EXPECT_EQ(steady.flickerSd.status, EstimateStatus::UpperLimit) << MakeText(steady);
  // A real flicker beside it is measured by the contrast of the frames, and without it as before.
  settings.conditions.flickerSd = 0.02;
  for (const Report & report : { Measure(Changed(wander, settings), {}).GetReport(),
                                 Measure(Simulate<GreyValue>(settings, Size, Size), {}).GetReport() })
  {
    ASSERT_TRUE(report.flickerSd.value && report.flickerSd.interval95) << MakeText(report);
    EXPECT_NEAR(*report.flickerSd.value, 0.02, 0.007) << MakeText(report); // of 40 frames; 4 standard errors are 0.009
  }
}

TEST(SensorNoiseRefinedWarnings, StrongVibration)
{
  SimulationSettings settings = StaticCamera(Frames);
  settings.conditions.vibrationSdXPixels = 0.8;
  ExpectWarns(Simulate<GreyValue>(settings, Size, Size), WarningCode::StrongVibration);
}

TEST(SensorNoiseRefinedWarnings, MotionNotUniform)
{
  // A bright board of squares is reflected into half of the frame, and stays where it is while the scene moves.
  SimulationSettings settings = StaticCamera(Frames);
  settings.conditions.vibrationSdXPixels = settings.conditions.vibrationSdYPixels = 0.1;
  std::mt19937                    random(3);
  std::poisson_distribution<long> electrons(3000.0);
  const auto                      withBoard = [&](auto, std::size_t x, std::size_t y, double u) {
    const bool isBright = x > Size / 2 && (x / 12 + y / 12) % 2 == 0;
    return u + (isBright ? static_cast<double>(electrons(random)) : 0.0); // gain 1 DN/e-
  };
  const Stack<GreyValue> stack = Changed(withBoard, settings);
  ExpectWarns(stack, WarningCode::MotionNotUniform);
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_FALSE(report.vibrationSdX.value && report.vibrationSdY.value);
  EXPECT_FALSE(report.vibrationCovariance.value);
  const Report plain = Measure(Simulate<GreyValue>(settings, Size, Size), {}).GetReport();
  EXPECT_FALSE(HasWarning(plain, WarningCode::MotionNotUniform));
  EXPECT_TRUE(plain.vibrationSdX.value && plain.vibrationSdY.value);
}

TEST(SensorNoiseRefinedWarnings, FlickerNotIdentifiable)
{
  const Report report =
    Measure(Simulate<GreyValue>(StaticCamera(Frames), Size, Size, FlatScene(Size, 0.05)), {}).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::FlickerNotIdentifiable)) << MakeText(report);
  EXPECT_FALSE(report.flickerSd.value);
  const std::string text = MakeText(report);
  EXPECT_NE(text.find("the illumination change is known only to within"), std::string::npos) << text;
  EXPECT_NE(text.find("25 % is needed for the flicker: give the offset (--offset)"), std::string::npos) << text;
}

TEST(SensorNoiseRefinedWarnings, NoiseNotLinear)
{
  SimulationSettings settings = StaticCamera(Frames);
  settings.flaws.median.radiusPixels = 1;
  ExpectWarns(Simulate<GreyValue>(settings, Size, Size, FlatScene(Size, 1.0)), WarningCode::NoiseNotLinear);
}

TEST(SensorNoiseRefinedWarnings, LeavesInTheWindAreNotMeasured)
{
  // In all but the upper rows the illumination of every pixel changes independently.
  const Report report = Measure(Changed([](std::size_t t, std::size_t x, std::size_t y, double u) {
                                  CounterSeededRandom random(7, t, x, y);
                                  const double        factor = 0.6 + 0.8 * random.Uniform();
                                  return y < 10 ? u : 100.0 + (u - 100.0) * factor + 400.0 * random.Uniform();
                                }),
                                {})
                          .GetReport();
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << MakeText(report);
  EXPECT_TRUE(HasWarning(report, WarningCode::NotStatic)) << MakeText(report);
  EXPECT_TRUE(std::any_of(report.warnings.begin(),
                          report.warnings.end(),
                          [](const Warning & own) { return KindOf(own.code).severity == Severity::Error; }))
    << MakeText(report);
}

// Only the last of 20 frames has a signal: the flicker absorbs all of its shot noise.
TEST(SensorNoiseRefinedWarnings, OneIlluminatedFrameIsNamed)
{
  SimulationSettings settings = StaticCamera(20);
  settings.illumination = IlluminationOf("pulses:0:20");
  const Report report = Measure(Simulate<GreyValue>(settings, Size, Size), {}).GetReport();
  EXPECT_NE(report.gain.status, EstimateStatus::Identified);
  ASSERT_TRUE(HasWarning(report, WarningCode::TooLittleToMeasure)) << MakeText(report);
  EXPECT_NE(MakeText(report).find("frame 19 alone carries "), std::string::npos) << MakeText(report);
}

TEST(SensorNoiseRefinedWarnings, VarianceSteps)
{
  // A second amplifier, with a read noise of 30 DN, reads the samples above a level in the middle of the target.
  const SimulationSettings   settings = StaticCamera(Frames);
  std::mt19937               random(5);
  std::normal_distribution<> normal;
  const double               switchDn = 0.4 * settings.camera.gainDnPerElectron * settings.camera.electrons;
  const Report               report =
    Measure(Changed([&](std::size_t, std::size_t, std::size_t, double value) {
              return value > settings.camera.offsetDn + switchDn ? value + 30.0 * normal(random) : value;
            }),
            {})
      .GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::VarianceSteps)) << MakeText(report);
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_LT(*report.gain.interval95->low, 1.0);
  EXPECT_GT(*report.gain.interval95->high, 1.0);
  EXPECT_FALSE(
    HasWarning(Measure(Simulate<GreyValue>(settings, Size, Size), {}).GetReport(), WarningCode::VarianceSteps));
}

TEST(SensorNoiseRefinedWarnings, BorderLeftOut)
{
  const SimulationSettings   settings = StaticCamera(Frames);
  std::mt19937               random(6);
  std::normal_distribution<> normal;
  const Stack<GreyValue>     stack = Changed([&](std::size_t, std::size_t x, std::size_t, double value) {
    return x < 10 ? settings.camera.offsetDn - 5.0 + 3.0 * normal(random) : value;
  });
  ExpectWarns(stack, WarningCode::BorderLeftOut);
  const std::vector<std::uint8_t> use = Measure(stack, {}).GetPixelUse();
  for (std::size_t p = 0; p < Size * Size; ++p)
  {
    EXPECT_EQ(use[p] == static_cast<std::uint8_t>(PixelUse::MaskedBorder), p % Size < 10) << p;
  }
}

TEST(SensorNoiseRefinedWarnings, LightSeriesLeft)
{
  // Bands of 8 rows and of 8 columns flicker independently: the flicker of one of both can be removed.
  constexpr std::size_t      bands = Size / 8;
  std::vector<double>        flicker;
  std::mt19937               random(7);
  std::normal_distribution<> normal;
  for (std::size_t i = 0; i < Frames * 2 * bands; ++i)
  {
    flicker.push_back(0.02 * normal(random));
  }
  const SimulationSettings settings = StaticCamera(Frames);
  const auto               inBands = [&](std::size_t t, std::size_t x, std::size_t y, double value) {
    const double factor = 1.0 + flicker[t * 2 * bands + y / 8] + flicker[(t * 2 + 1) * bands + x / 8];
    return settings.camera.offsetDn + factor * (value - settings.camera.offsetDn);
  };
  const Report report = Measure(Changed(inBands), {}).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::LightSeriesLeft)) << MakeText(report);
}

// Caustics: in each frame the illumination has waves of 12 pixels with random directions and phases, of 0.5 % rms
// together.
TEST(SensorNoiseRefinedWarnings, IlluminationOfFinePatternsIsNoFilter)
{
  constexpr std::size_t            waves = 8;
  constexpr double                 perPixel = 6.283185307179586 / 12.0;
  std::mt19937                     random(11);
  std::uniform_real_distribution<> angle(0.0, 6.283185307179586);
  std::vector<double>              angles(2 * waves * Frames);
  std::generate(angles.begin(), angles.end(), [&] { return angle(random); });
  const SimulationSettings settings = StaticCamera(Frames);
  const auto               lit = [&](std::size_t t, std::size_t x, std::size_t y, double value) {
    double factor = 1.0;
    for (std::size_t w = 0; w < waves; ++w)
    {
      const double * const own = angles.data() + 2 * (t * waves + w);
      const double along = std::cos(own[0]) * static_cast<double>(x) + std::sin(own[0]) * static_cast<double>(y);
      factor += 0.0025 * std::cos(perPixel * along + own[1]);
    }
    return settings.camera.offsetDn + factor * (value - settings.camera.offsetDn);
  };
  const Report report = Measure(Changed(lit), {}).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::NoiseNotLinear)) << MakeText(report);
  EXPECT_FALSE(HasWarning(report, WarningCode::NoiseCorrelated)) << MakeText(report);
  EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
  EXPECT_NE(MakeText(report).find("grows with the square of the signal"), std::string::npos) << MakeText(report);
}

// A camera conceals lost rows by the row above: 2 % of the rows, others in each frame.
TEST(SensorNoiseRefinedWarnings, ConcealedRowsAreNoFilter)
{
  Stack<GreyValue>            stack = Simulate<GreyValue>(StaticCamera(Frames), Size, Size);
  std::mt19937                random(8);
  std::bernoulli_distribution isLost(0.02);
  for (std::size_t row = 1; row < Frames * Size; ++row)
  {
    if (row % Size != 0 && isLost(random))
    {
      std::copy_n(stack.pixels.data() + (row - 1) * Size, Size, stack.pixels.data() + row * Size);
    }
  }
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << MakeText(report);
  ASSERT_TRUE(HasWarning(report, WarningCode::NoiseNotLinear)) << MakeText(report);
  EXPECT_NE(MakeText(report).find("copies of the row before them"), std::string::npos) << MakeText(report);
}

// Half of the blocks of 8 x 8 pixels repeat the previous frame.
TEST(SensorNoiseRefinedWarnings, SkippedBlocksAreNoFilter)
{
  Stack<GreyValue>            stack = Simulate<GreyValue>(StaticCamera(Frames), Size, Size);
  std::mt19937                random(8);
  std::bernoulli_distribution isSkipped(0.5);
  for (std::size_t t = 1; t < Frames; ++t)
  {
    for (std::size_t block = 0; block < Size * Size / 64; ++block)
    {
      const std::size_t first = block / (Size / 8) * 8 * Size + block % (Size / 8) * 8;
      const std::size_t pixels = isSkipped(random) ? 64 : 0;
      for (std::size_t k = 0; k < pixels; ++k)
      {
        const std::size_t own = t * Size * Size + first + k / 8 * Size + k % 8;
        stack.pixels[own] = stack.pixels[own - Size * Size];
      }
    }
  }
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << MakeText(report);
  ASSERT_TRUE(HasWarning(report, WarningCode::NoiseNotLinear)) << MakeText(report);
  EXPECT_NE(MakeText(report).find("repeat their value in the frame before"), std::string::npos) << MakeText(report);
}

TEST(SensorNoiseRefinedWarnings, GainNotUniform)
{
  // Two cameras show one scene side by side; their gains differ by a quarter.
  SimulationSettings settings = StaticCamera(Frames);
  Stack<GreyValue>   stack = Simulate<GreyValue>(settings, Size, Size);
  settings.camera.gainDnPerElectron *= 1.25;
  const Stack<GreyValue> other = Simulate<GreyValue>(settings, Size, Size);
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    stack.pixels[i] = i % Size < Size / 2 ? stack.pixels[i] : other.pixels[i];
  }
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::GainNotUniform)) << MakeText(report);
  ASSERT_EQ(report.gainByParts.size(), 1U);
  EXPECT_EQ(report.gainByParts[0].pattern, "left-right");
  const double expected[] = { 1.0, 1.25 };
  for (std::size_t k = 0; k < 2; ++k)
  {
    const GainByPartsRecord::Part & part = report.gainByParts[0].parts[k];
    EXPECT_NEAR(part.gain, expected[k], 4.0 * part.standardError) << part.name;
    EXPECT_LT(part.standardError, 0.03) << part.name;
    EXPECT_LT(*report.gain.interval95->low, expected[k]);
    EXPECT_GT(*report.gain.interval95->high, expected[k]);
  }
}
