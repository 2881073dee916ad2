// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/StackMethod.h"
#include "simulation/Random.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 192;
constexpr std::size_t Frames = 50;

/** Returns frames with a textured object, a third of the frame wide, that moves through the lower two thirds of the
 * rows. */
Stack<unsigned short>
TransientStack(const std::vector<double> & scene, int conditions, bool isVertical)
{
  SimulationSettings settings;
  settings.conditions = PaperConditions(conditions);
  settings.frames = Frames;
  settings.seed = 3;
  const StackSimulator  simulator(scene, Size, Size, settings);
  Stack<unsigned short> stack{ Size, Size, Frames, std::vector<unsigned short>(Size * Size * Frames) };
  constexpr double      length = Size / 3.0;
  std::vector<double>   electrons(Size);
  for (std::size_t row = 0; row < Frames * Size; ++row)
  {
    const std::size_t   t = row / Size;
    const std::size_t   y = row % Size;
    const double        front = (Size + length) * static_cast<double>(t) / (Frames - 1.0);
    const double        signal = settings.camera.electrons * (1.0 + simulator.GetTruth().series.gamma[t]);
    CounterSeededRandom random(settings.seed, 100, t, y);
    simulator.ExpectedElectronsRow(t, y, electrons.data());
    for (std::size_t x = 0; x < Size; ++x)
    {
      const auto   along = static_cast<double>(isVertical ? y : x);
      const auto   across = static_cast<double>(isVertical ? x : y);
      const double depth = front - along;
      if (across >= length && depth > 0.0 && depth < length)
      {
        electrons[x] = signal * (0.4 + 0.2 * std::sin(depth / 4.0) * std::sin(across / 7.0));
      }
      const double value = static_cast<double>(random.Poisson(electrons[x])) + settings.camera.offsetDn +
                           settings.camera.readNoiseDn * random.Normal();
      stack.pixels[row * Size + x] = static_cast<unsigned short>(std::clamp(std::floor(value + 0.5), 0.0, 4095.0));
    }
  }
  return stack;
}

/** Returns frames of \a size x \a size pixels that are, in the squares of a checkerboard, the mean of two exposures. */
Stack<unsigned short>
MergedStack(std::size_t size)
{
  SimulationSettings settings;
  settings.conditions = { 0.03, 0.0, 0.0 };
  settings.frames = Frames;
  const StackSimulator  simulator(MakeTextureScene(size, size), size, size, settings);
  Stack<unsigned short> stack{ size, size, Frames, std::vector<unsigned short>(size * size * Frames) };
  constexpr std::size_t side = 60; // not the side of a part of the sensor
  std::vector<double>   electrons(size);
  for (std::size_t row = 0; row < Frames * size; ++row)
  {
    const std::size_t   y = row % size;
    CounterSeededRandom random(settings.seed, 100, row / size, y);
    simulator.ExpectedElectronsRow(row / size, y, electrons.data());
    for (std::size_t x = 0; x < size; ++x)
    {
      const std::size_t exposures = (x / side + y / side) % 2 + 1;
      double            sum = 0.0;
      for (std::size_t k = 0; k < exposures; ++k)
      {
        sum += static_cast<double>(random.Poisson(electrons[x])) + settings.camera.offsetDn +
               settings.camera.readNoiseDn * random.Normal();
      }
      const double value = sum / static_cast<double>(exposures);
      stack.pixels[row * size + x] = static_cast<unsigned short>(std::clamp(std::floor(value + 0.5), 0.0, 4095.0));
    }
  }
  return stack;
}

void
ExpectTruth(const Stack<unsigned short> & stack, bool isVertical)
{
  const auto     method = Measure(stack);
  const Report & report = method.GetReport();
  EXPECT_FALSE(HasWarning(report, WarningCode::GainNotUniform));
  const double gain = ValueOf(report.gain);
  EXPECT_LE(std::abs(gain - 1.0), std::max(0.01, 3.0 * *report.gain.standardError));
  EXPECT_LT(*report.gain.standardError, 0.007); // a third of the frame gives 0.4 %
  const auto & use = method.GetPixelUse();
  std::size_t  moved = 0;
  std::size_t  used = 0;
  for (std::size_t p = 0; p < use.size(); ++p)
  {
    const std::size_t across = isVertical ? p % Size : p / Size;
    if (use[p] == static_cast<std::uint8_t>(PixelUse::Used))
    {
      moved += across >= Size / 3 ? 1 : 0;
      ++used;
    }
  }
  EXPECT_LT(static_cast<double>(moved), 0.03 * static_cast<double>(used));
  EXPECT_GT(static_cast<double>(used), 0.2 * static_cast<double>(use.size()));
}
} // namespace

TEST(SensorNoiseMovingObject, GainComesFromTheRowsThatItNeverReaches)
{
  for (const int conditions : { 1, 2, 3 })
  {
    SCOPED_TRACE(conditions);
    ExpectTruth(TransientStack(MakeTextureScene(Size, Size), conditions, false), false);
    ExpectTruth(TransientStack(MakeTargetScene(Size, Size), conditions, false), false);
  }
}

TEST(SensorNoiseMovingObject, GainComesFromTheColumnsThatItNeverReaches)
{
  for (const int conditions : { 1, 3 })
  {
    SCOPED_TRACE(conditions);
    ExpectTruth(TransientStack(MakeTextureScene(Size, Size), conditions, true), true);
    ExpectTruth(TransientStack(MakeTargetScene(Size, Size), conditions, true), true);
  }
}

TEST(SensorNoiseMovingObject, ResultDoesNotDependOnThreadsAndChunks)
{
  const auto stack = TransientStack(MakeTextureScene(Size, Size), 1, false);
  const auto whole = Measure(stack);
  const auto parts = Measure(stack, WithDnSettings(), 7, Threads(3));
  EXPECT_EQ(*whole.GetReport().gain.value, *parts.GetReport().gain.value);
  EXPECT_TRUE(HaveSameBits(whole.GetPixelUse(), parts.GetPixelUse()));
}

TEST(SensorNoiseMovingObject, PixelsOfAnotherGainAreNone)
{
  for (const std::size_t size : { Size, 2 * Size / 3 }) // in the smaller one, the roughest pixels have too few tiles
  {
    SCOPED_TRACE(size);
    const Report report = Measure(MergedStack(size)).GetReport();
    EXPECT_TRUE(HasWarning(report, WarningCode::GainNotUniform));
    if (report.gain.status == EstimateStatus::Identified) // then its interval has the gain of one exposure
    {
      ASSERT_TRUE(report.gain.interval95);
      EXPECT_GE(report.gain.interval95->high.value_or(2.0), 1.0);
    }
  }
}
