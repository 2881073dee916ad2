// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectionSums.h"
#include "refined/PixelProjections.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = float; // whole numbers whose sums need 8 bytes: the sums of integers fit within the least memory

constexpr std::size_t Width = 1100;
constexpr std::size_t Height = 1000;
constexpr std::size_t Frames = 12;
static_assert(Width * Height > 2 * ProjectionSums::SlabPixels, "the frames have three slabs");

/** Returns waves with noise of 1 DN/e- and 10 DN^2, under flicker that is uniform, or differs between bands of rows. */
Stack<GreyValue>
FramesOf(bool isIlluminationLocal)
{
  Stack<GreyValue>                stack{ Width, Height, Frames, {} };
  std::minstd_rand                random(19);
  std::normal_distribution<float> normal;
  stack.pixels.reserve(Width * Height * Frames);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    for (std::size_t y = 0; y < Height; ++y)
    {
      const double phase =
        1.7 * static_cast<double>(t * t) + (isIlluminationLocal ? static_cast<double>(y) / 60.0 : 0.0);
      const double brightness = 1.0 + 0.04 * std::sin(phase);
      for (std::size_t x = 0; x < Width; ++x)
      {
        const double wave = static_cast<double>((x / 4 + y / 8) % 16) / 16.0;
        const double signal = (200.0 + 1400.0 * wave) * brightness;
        stack.pixels.push_back(
          static_cast<GreyValue>(std::lround(200.0 + signal + std::sqrt(10.0 + signal) * normal(random))));
      }
    }
  }
  return stack;
}

struct Limited
{
  RefinedMethod<GreyValue> method;
  unsigned int             passes{ 0 };
};

Limited
MeasureWithin(const Stack<GreyValue> & stack, double bytes)
{
  RefinedSettings settings = WithDnSettings();
  settings.memoryLimitBytes = bytes;
  Limited limited{ RefinedMethod<GreyValue>(settings, GeometryOf(stack), Frames, {}, Threads(2)) };
  for (; !limited.method.IsDone(); ++limited.passes)
  {
    limited.method.AddFrames(stack.Frame(0), Frames / 2);
    limited.method.AddFrames(stack.Frame(Frames / 2), Frames / 2);
    limited.method.EndPass();
  }
  return limited;
}

/** Measures without merging, within the least memory. In the third pass all frames are added together, discarded, and
 * added again, \a atOnce at a time. */
Limited
MeasureWithoutSavedSums(const Stack<GreyValue> & stack, std::size_t atOnce)
{
  RefinedSettings settings = WithDnSettings();
  settings.memoryLimitBytes = MemoryNeed{ Width * Height, Frames }.Least();
  Limited limited{ RefinedMethod<GreyValue>(settings, GeometryOf(stack), Frames, {}, Threads(2)) };
  limited.method.DisableMerging();
  for (; !limited.method.IsDone(); ++limited.passes)
  {
    limited.method.AddFrames(stack.Frame(0), Frames);
    if (limited.passes == 2)
    {
      limited.method.ForgetSums();
      for (std::size_t t = 0; t < Frames; t += atOnce)
      {
        limited.method.AddFrames(stack.Frame(t), atOnce);
      }
    }
    limited.method.EndPass();
  }
  return limited;
}

void
ExpectSameBits(const Limited & a, const Limited & b)
{
  EXPECT_EQ(ToJson(a.method.GetReport()), ToJson(b.method.GetReport()));
  EXPECT_TRUE(HaveSameBits(a.method.GetMean(), b.method.GetMean()));
  EXPECT_TRUE(HaveSameBits(a.method.GetCorrectedVariance(), b.method.GetCorrectedVariance()));
  EXPECT_TRUE(HaveSameBits(a.method.GetPixelUse(), b.method.GetPixelUse()));
}

class SensorNoiseMemoryLimit : public ::testing::TestWithParam<bool>
{};
} // namespace

TEST_P(SensorNoiseMemoryLimit, ReadsMoreOftenAndChangesNoBit)
{
  const Stack<GreyValue> stack = FramesOf(this->GetParam());
  const Limited          free = MeasureWithin(stack, std::numeric_limits<double>::infinity());
  EXPECT_EQ(free.passes, 3U);
  EXPECT_EQ(HasWarning(free.method.GetReport(), WarningCode::LocalLight), this->GetParam());
  const Limited limited = MeasureWithin(stack, MemoryNeed{ Width * Height, Frames }.Least());
  EXPECT_GT(limited.passes, this->GetParam() ? 4U : 3U); // one more for the components of the illumination
  ExpectSameBits(limited, free);
}

TEST_P(SensorNoiseMemoryLimit, AllFramesAtOnceNeedNoSumsAndNoMorePasses)
{
  const Stack<GreyValue> stack = FramesOf(this->GetParam());
  const Limited          free = MeasureWithin(stack, std::numeric_limits<double>::infinity());
  const Limited          atOnce = MeasureWithoutSavedSums(stack, Frames);
  EXPECT_EQ(atOnce.passes, 3U);
  ExpectSameBits(atOnce, free);
  const Limited inHalves = MeasureWithoutSavedSums(stack, Frames / 2);
  EXPECT_GT(inHalves.passes, this->GetParam() ? 4U : 3U);
  ExpectSameBits(inHalves, free);
}

INSTANTIATE_TEST_SUITE_P(Light, SensorNoiseMemoryLimit, ::testing::Bool(), [](const auto & signal) {
  return signal.param ? "Local" : "Common";
});

TEST(SensorNoiseMemoryLimit, KeptSumsAreNotSavedOrMerged)
{
  const Stack<GreyValue>   stack = FramesOf(false);
  RefinedMethod<GreyValue> method(WithDnSettings(), GeometryOf(stack), Frames, {}, Threads(2));
  method.DisableMerging();
  std::stringstream sums;
  for (int pass = 0; pass < 2; ++pass)
  {
    method.AddFrames(stack.Frame(0), Frames);
    EXPECT_NO_THROW(method.SaveSums(sums));
    method.EndPass();
  }
  EXPECT_THROW(method.SaveSums(sums), std::logic_error);
}

TEST(SensorNoiseMemoryLimit, BelowTheLeastIsRefused)
{
  RefinedSettings settings = WithDnSettings();
  settings.memoryLimitBytes = MemoryNeed{ 640 * 480, 20 }.Least();
  EXPECT_NO_THROW(RefinedMethod<GreyValue>(settings, { 640, 480, 1 }, 20));
  settings.memoryLimitBytes -= 1.0;
  try
  {
    RefinedMethod<GreyValue>(settings, { 640, 480, 1 }, 20);
    FAIL() << "no error";
  }
  catch (const std::invalid_argument & error)
  {
    EXPECT_EQ(std::string(error.what()),
              "the memory limit is 30.5 MB; expected at least 30.5 MB for frames of 640 x 480 pixels");
  }
}

TEST(SensorNoiseMemoryNeed, IsThatOfTheMapsTheFramesAndTheSample)
{
  const MemoryNeed need{ 4'000'000, 100 };
  EXPECT_DOUBLE_EQ(need.Least(), 64.0 * 4e6 + 20e3 * 100.0 + 33554432.0);
  EXPECT_DOUBLE_EQ(need.OfProjections(9, SumWidth::Wide), 8.0 * 9.0 * 4e6);
  EXPECT_DOUBLE_EQ(need.OfProjections(9, SumWidth::Narrow), 4.0 * 9.0 * 4e6);
  EXPECT_LT(need.BesideProjections(), need.Least());
}
