// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "mosaic/MosaicPasses.h"
#include "refined/RefinedPasses.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

/** \file
 * The refined method under strong changes of the illumination, for which it reads the stack once more. */

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;

SimulationSettings
StrongSettings(const std::string & illumination)
{
  SimulationSettings settings;
  settings.camera = { 4000.0, 0.5, 100.0, 3.0 };
  settings.conditions = { 0.01, 0.01, 0.02 };
  settings.illumination = IlluminationOf(illumination);
  settings.frames = 40;
  settings.seed = 5;
  return settings;
}

const Stack<GreyValue> &
StrongStack()
{
  static const auto stack = Simulate<GreyValue>(StrongSettings("pulses:0.3:4"), 96, 80);
  return stack;
}

template <typename TMethod>
std::size_t
RunPasses(TMethod & method, const Stack<GreyValue> & stack, std::size_t chunk)
{
  std::size_t passes = 0;
  for (; !method.IsDone(); ++passes)
  {
    for (std::size_t t = 0; t < stack.frames; t += chunk)
    {
      method.AddFrames(stack.Frame(t), std::min(chunk, stack.frames - t));
    }
    method.EndPass();
  }
  return passes;
}

RefinedMethod<GreyValue>
MethodOf(const Stack<GreyValue> & stack, const ParallelFor & parallelFor = SerialFor)
{
  return RefinedMethod<GreyValue>(RefinedSettings(), GeometryOf(stack), stack.frames, {}, parallelFor);
}

void
ExpectSameBits(const RefinedMethod<GreyValue> & a, const RefinedMethod<GreyValue> & b)
{
  EXPECT_EQ(ToJson(a.GetReport()), ToJson(b.GetReport()));
  EXPECT_TRUE(HaveSameBits(a.GetMean(), b.GetMean()));
  EXPECT_TRUE(HaveSameBits(a.GetVariance(), b.GetVariance()));
  EXPECT_TRUE(HaveSameBits(a.GetCorrectedVariance(), b.GetCorrectedVariance()));
  EXPECT_TRUE(HaveSameBits(a.GetPixelUse(), b.GetPixelUse()));
}
} // namespace

TEST(SensorNoiseStrongIllumination, IsReadOnceMoreAndSmallFlickerIsNot)
{
  auto strong = MethodOf(StrongStack());
  EXPECT_EQ(RunPasses(strong, StrongStack(), 40), 4U);
  const auto steady = Simulate<GreyValue>(StrongSettings("steady"), 96, 80);
  auto       ordinary = MethodOf(steady);
  EXPECT_EQ(RunPasses(ordinary, steady, 40), 3U);
}

TEST(SensorNoiseStrongIllumination, GainOffsetAndReadNoiseAreTheCameras)
{
  for (const char * const shape : { "pulses:0.3:4", "sine:0:7.3", "uniform:0", "decay:0.3" })
  {
    const auto     stack = Simulate<GreyValue>(StrongSettings(shape), 160, 128);
    const auto     method = Measure(stack);
    const Report & report = method.GetReport();
    ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << shape;
    // 4 standard errors, exceeded once in 16,000 by chance; offset and read noise are tested, too.
    EXPECT_NEAR(*report.gain.value, 0.5, 4.0 * *report.gain.standardError) << shape;
    EXPECT_LT(*report.gain.standardError, 0.01 * 0.5) << shape;
    ASSERT_EQ(report.offset.status, EstimateStatus::Identified) << shape;
    EXPECT_NEAR(*report.offset.value, 100.0, 4.0 * *report.offset.standardError) << shape;
    ASSERT_EQ(report.readNoise.status, EstimateStatus::Identified) << shape;
    EXPECT_NEAR(*report.readNoise.value, 3.0, 4.0 * *report.readNoise.standardError) << shape;
  }
}

TEST(SensorNoiseStrongIllumination, OrdinaryFlickerOfLargeWellsIsNoGain)
{
  // Flicker of 5 % of 2 million electrons has 5,000 times the variance of shot noise. With a scene far above the dark
  // offset, it makes the slope of the initial noise model a thousand times the gain.
  SimulationSettings settings = StrongSettings("steady");
  settings.camera = { 2e6, 0.02, 100.0, 1.2 };
  settings.conditions = { 0.05, 0.02, 0.05 };
  settings.bitDepth = 16;
  settings.seed = 1;
  std::vector<double> scene = MakeTargetScene(160, 128);
  for (double & level : scene)
  {
    level = 0.4 + 0.6 * level;
  }
  const Report report = Measure(Simulate<GreyValue>(settings, 160, 128, scene), RefinedSettings()).GetReport();
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, 0.02, 4.0 * *report.gain.standardError);
  EXPECT_LT(*report.gain.standardError, 0.005 * 0.02);
}

TEST(SensorNoiseStrongIllumination, FramesWithoutIlluminationAreNotUnlikeTheOthers)
{
  // The variance without light is a thousandth of the others, and less than what the line knows of it.
  SimulationSettings settings = StrongSettings("pulses:0:2");
  settings.camera = { 12000.0, 0.18, 350.0, 0.45 };
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.frames = 20;
  const Report report = Measure(Simulate<GreyValue>(settings, 160, 128)).GetReport();
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, 0.18, 4.0 * *report.gain.standardError);
  EXPECT_TRUE(report.framesLeftOut.empty());
}

TEST(SensorNoiseStrongIllumination, RoundingIsAnErrorOfAnOffsetByFramesWithoutIllumination)
{
  // With a noise of 0.18 steps, rounding shifts a level of 147.2 DN by -0.15 DN in all pixels alike.
  SimulationSettings settings = StrongSettings("pulses:0:4");
  settings.camera = { 1500.0, 0.1, 147.2, 0.18 };
  settings.conditions = { 0.0, 0.0, 0.0 };
  const Report report = Measure(Simulate<GreyValue>(settings, 160, 128)).GetReport();
  ASSERT_EQ(report.offset.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.offset.value, 147.2, 3.0 * *report.offset.standardError);
  EXPECT_GT(std::abs(*report.offset.value - 147.2), 0.05);
}

TEST(SensorNoiseStrongIllumination, OfAFlatFieldDeterminesGainAndInterceptButNoOffset)
{
  for (const double offset : { 100.0, 4000.0 })
  {
    for (const char * const shape : { "pulses:0:4", "pulses:0.3:4", "sine:0:7.3", "uniform:0", "decay:0.3" })
    {
      SimulationSettings settings = StrongSettings(shape);
      settings.camera.offsetDn = offset;
      settings.bitDepth = 16;
      const auto   stack = Simulate<GreyValue>(settings, 160, 128, std::vector<double>(160 * 128, 1.0));
      const Report report = Measure(stack, RefinedSettings()).GetReport();
      ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << shape << " " << offset << ToJson(report);
      EXPECT_NEAR(*report.gain.value, 0.5, 4.0 * *report.gain.standardError) << shape;
      EXPECT_LT(*report.gain.standardError, 0.01 * 0.5) << shape;
      ASSERT_EQ(report.intercept.status, EstimateStatus::Identified) << shape;
      EXPECT_NEAR(*report.intercept.value, 9.0 - 0.5 * offset, 4.0 * *report.intercept.standardError) << shape;
      // A sensor with mu + d and sigma^2 + g d has the same variance at every level.
      EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable) << shape;
      EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable) << shape;
      ASSERT_TRUE(report.offset.bracket && report.offset.bracket->high) << shape;
      EXPECT_GT(*report.offset.bracket->high, offset) << shape;
      EXPECT_TRUE(report.framesLeftOut.empty()) << shape;
      // Unequal frames leave few degrees of freedom. With too many, pixels of large variance are rejected as outliers.
      // All pixels except the border, 2 pixels wide, are used.
      EXPECT_GT(static_cast<double>(report.pixels.used), 0.99 * 156 * 124) << shape << " " << offset;
    }
  }
}

// Fifteen of 60 frames are lit. The noise of the dark frames is ten times smaller, which is no local illumination. A
// pulsed lamp under a rolling shutter has two temporal components, a sine and a cosine of the rows.
TEST(SensorNoiseStrongIllumination, FewIlluminatedFramesAreNoLocalIllumination)
{
  for (const double periodRows : { 0.0, 40.0 })
  {
    for (const std::size_t seed : { 2u, 3u, 4u })
    {
      SimulationSettings settings = StrongSettings("pulses:0:4");
      settings.rollingShutterPeriodRows = periodRows;
      settings.conditions.flickerSd = 0.02;
      settings.frames = 60;
      settings.seed = seed;
      const auto     stack = Simulate<GreyValue>(settings, 160, 128);
      const auto     method = Measure(stack);
      const Report & report = method.GetReport();
      const bool     isRolling = periodRows > 0.0;
      EXPECT_EQ(HasWarning(report, WarningCode::LocalLight), isRolling) << seed;
      EXPECT_EQ(MakeText(report).find("(2 further temporal components)") != std::string::npos, isRolling)
        << MakeText(report);
      ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << periodRows << ' ' << seed;
      EXPECT_NEAR(*report.gain.value, 0.5, 4.0 * *report.gain.standardError) << periodRows << ' ' << seed;
      // 1 ± 0.18 with 62 degrees of freedom.
      EXPECT_NEAR(*report.fit.reducedChi2, 1.0, 4.0 * 0.18) << periodRows << ' ' << seed;
    }
  }
}

TEST(SensorNoiseStrongIllumination, DarkFramesHaveNoShift)
{
  const auto     stack = Simulate<GreyValue>(StrongSettings("pulses:0:4"), 160, 128);
  const auto     method = Measure(stack);
  const Report & report = method.GetReport();
  ASSERT_EQ(report.motion.size(), 40U);
  for (std::size_t t = 0; t < report.motion.size(); ++t)
  {
    EXPECT_EQ(std::isfinite(report.motion[t][1]), t % 4 == 3) << t;
  }
  // The standard deviation of the shifts of 10 lit frames has the relative error 1 / sqrt(2 * 9); 4 of these are
  // allowed.
  ASSERT_TRUE(report.vibrationSdX.value && report.vibrationSdY.value);
  EXPECT_NEAR(*report.vibrationSdX.value, 0.01, 0.01 * 4.0 / std::sqrt(18.0));
  EXPECT_NEAR(*report.vibrationSdY.value, 0.02, 0.02 * 4.0 / std::sqrt(18.0));
}

TEST(SensorNoiseStrongIllumination, WithoutGammaTheShiftsHaveEqualWeights)
{
  SimulationSettings settings;
  settings.frames = 60;
  settings.prnuSd = 0.3; // the contrast of a flat field, whose offset is not known
  const Report report =
    Measure(Simulate<GreyValue>(settings, 160, 128, std::vector<double>(160 * 128, 1.0))).GetReport();
  ASSERT_FALSE(report.flickerSd.value);
  ASSERT_TRUE(report.vibrationSdX.interval95 || report.vibrationSdX.bracket);
  const Interval limits = report.vibrationSdX.interval95.value_or(report.vibrationSdX.bracket.value_or(Interval{}));
  EXPECT_TRUE(std::isfinite(limits.high.value_or(0.0)));
}

TEST(SensorNoiseStrongIllumination, VarianceThatIsShownIsThatOverTime)
{
  const auto &      stack = StrongStack();
  auto              method = MethodOf(stack);
  const std::size_t pixels = stack.width * stack.height;
  RunPasses(method, stack, 11);
  for (std::size_t p = 0; p < pixels; p += 7)
  {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t t = 0; t < stack.frames; ++t)
    {
      sum += stack.Frame(t)[p];
      squares += static_cast<double>(stack.Frame(t)[p]) * stack.Frame(t)[p];
    }
    const auto   frames = static_cast<double>(stack.frames);
    const double variance = (squares - sum * sum / frames) / (frames - 1.0);
    ASSERT_NEAR(method.GetVariance()[p], variance, 1e-7 * variance);
    ASSERT_NEAR(method.GetMean()[p], sum / frames, 1e-9 * sum);
  }
}

TEST(SensorNoiseStrongIllumination, SameBitsForAnyChunksThreadsAndOrder)
{
  const auto & stack = StrongStack();
  auto         whole = MethodOf(stack);
  RunPasses(whole, stack, stack.frames);
  ASSERT_EQ(whole.GetReport().gain.status, EstimateStatus::Identified);
  const auto threads = Threads(3);
  auto       chunks = MethodOf(stack, threads);
  RunPasses(chunks, stack, 7);
  ExpectSameBits(chunks, whole);
  auto withoutMerging = MethodOf(stack);
  withoutMerging.DisableMerging();
  RunPasses(withoutMerging, stack, stack.frames);
  ExpectSameBits(withoutMerging, whole);
  auto turned = MethodOf(stack);
  while (!turned.IsDone())
  {
    turned.AddFrames(stack.Frame(3), 7);
    turned.ForgetSums();
    for (std::size_t t = stack.frames; t-- > 0;)
    {
      turned.GoTo(t);
      turned.AddFrames(stack.Frame(t), 1);
    }
    turned.EndPass();
  }
  ExpectSameBits(turned, whole);
}

TEST(SensorNoiseStrongIllumination, ProcessesThatExchangeSumsHaveTheBitsOfTheWhole)
{
  const auto & stack = StrongStack();
  auto         whole = MethodOf(stack);
  RunPasses(whole, stack, stack.frames);
  std::vector<RefinedMethod<GreyValue>> parts;
  parts.push_back(MethodOf(stack));
  parts.push_back(MethodOf(stack));
  std::size_t passes = 0;
  for (; !parts[0].IsDone(); ++passes)
  {
    std::array<std::stringstream, 2> sums;
    for (std::size_t i = 0; i < 2; ++i)
    {
      for (std::size_t t = 0; t < stack.frames; ++t)
      {
        t % 3 % 2 == i ? parts[i].AddFrames(stack.Frame(t), 1) : parts[i].SkipFrames(1);
      }
      parts[i].SaveSums(sums.at(i));
    }
    parts[0].MergeSums(sums[1]);
    parts[1].MergeSums(sums[0]);
    parts[0].EndPass();
    parts[1].EndPass();
  }
  EXPECT_EQ(passes, 4U);
  ExpectSameBits(parts[0], whole);
  ExpectSameBits(parts[1], whole);
}

TEST(SensorNoiseStrongIllumination, SumsOfAnotherReadingAreRefused)
{
  // Another stack has other means: the component onto which pixels are projected differs.
  const auto & stack = StrongStack();
  const auto   other = stack.Map([](GreyValue u) { return u + 1; });
  auto         method = MethodOf(stack);
  auto         another = MethodOf(other);
  method.AddFrames(stack.Frame(0), stack.frames);
  another.AddFrames(other.Frame(0), stack.frames);
  method.EndPass();
  another.EndPass();
  std::stringstream sums;
  another.AddFrames(other.Frame(0), 1);
  another.SaveSums(sums);
  method.SkipFrames(1);
  EXPECT_THROW(method.MergeSums(sums), std::runtime_error);
}

TEST(SensorNoiseStrongIllumination, PlanesOfAMosaicFindWhatTheyFindAlone)
{
  SimulationSettings settings = StrongSettings("sine:0.1:9");
  settings.flaws.filters.pattern = BayerPattern::RGGB;
  Stack<GreyValue>     stack = Simulate<GreyValue>(settings, 128, 128);
  const MosaicGeometry geometry{ { stack.width, stack.height, 1 }, BayerPattern::RGGB };
  const std::size_t    pixels = stack.width * stack.height;
  // The last plane has steady illumination and needs no additional pass: the planes are not in step.
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    for (std::size_t y = 1; y < stack.height; y += 2)
    {
      for (std::size_t x = 1; x < stack.width; x += 2)
      {
        const std::size_t p = y * stack.width + x;
        stack.pixels[t * pixels + p] = static_cast<GreyValue>(400 + 3 * (x + y) + (7 * t + 5 * p + t * p) % 23);
      }
    }
  }
  const auto make = [&](BayerPlane, const ParallelFor & parallelFor) {
    return RefinedPasses<GreyValue>(RefinedSettings(), geometry.Plane(), stack.frames, {}, parallelFor);
  };
  for (const std::size_t chunk : { std::size_t{ 9 }, stack.frames })
  {
    MosaicPasses<GreyValue, RefinedPasses<GreyValue>> mosaic(geometry, make, Threads(3), 3);
    mosaic.DisableMerging(MosaicPasses<GreyValue, RefinedPasses<GreyValue>>::ManySums{ 0, 0 });
    RunPasses(mosaic, stack, chunk);
    for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
    {
      Stack<GreyValue> alone{ geometry.Plane().width, geometry.Plane().height, stack.frames, {} };
      for (std::size_t t = 0; t < stack.frames; ++t)
      {
        const auto frame =
          geometry.Take(std::vector<GreyValue>(stack.Frame(t), stack.Frame(t) + pixels), BayerPlanes.at(k));
        alone.pixels.insert(alone.pixels.end(), frame.begin(), frame.end());
      }
      auto method = MethodOf(alone);
      EXPECT_EQ(RunPasses(method, alone, stack.frames), k < 3 ? 4U : 3U) << k;
      EXPECT_EQ(ToJson(mosaic.GetReports().at(k)), ToJson(method.GetReport())) << k;
    }
    ASSERT_EQ(mosaic.GetReports()[0].gain.status, EstimateStatus::Identified);
    EXPECT_NEAR(*mosaic.GetReports()[0].gain.value, 0.5, 4.0 * *mosaic.GetReports()[0].gain.standardError);
  }
}
