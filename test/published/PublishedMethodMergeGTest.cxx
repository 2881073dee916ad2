// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/Simulator.h"
#include "helpers/PublishedTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Several processes, each with a part of the frames.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
PublishedSettings
ByRow()
{
  PublishedSettings settings;
  settings.rollingShutter = RollingShutter::Fixed;
  settings.sigmaRows = 8.0;
  return settings;
}

template <typename TPixel>
PublishedMethod<TPixel>
MethodOf(const Stack<TPixel> & stack, const PublishedSettings & settings)
{
  return PublishedMethod<TPixel>(settings, { stack.width, stack.height, settings.shutterAxis }, stack.frames);
}

/** Measures with \a count processes. Each reads every \a count-th frame, backwards if possible, and merges the sums of
 * all others. */
template <typename TPixel>
std::vector<PublishedMethod<TPixel>>
MeasureInTurn(const Stack<TPixel> & stack, const PublishedSettings & settings, std::size_t count)
{
  std::vector<PublishedMethod<TPixel>> processes;
  for (std::size_t i = 0; i < count; ++i)
  {
    processes.push_back(MethodOf(stack, settings));
  }
  for (unsigned int pass = 0; pass < PublishedMethod<TPixel>::NumberOfPasses; ++pass)
  {
    std::vector<std::string> sums;
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t t = stack.frames; t-- > 0;)
      {
        if (t % count == i)
        {
          processes[i].GoTo(t);
          processes[i].AddFrames(stack.Frame(t), 1);
        }
      }
      std::ostringstream out;
      processes[i].SaveSums(out);
      sums.push_back(out.str());
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t k = 1; k < count; ++k)
      {
        std::istringstream in(sums[(i + k) % count]);
        processes[i].MergeSums(in);
      }
      processes[i].EndPass();
    }
  }
  return processes;
}
} // namespace

TEST(SensorNoisePublishedMethodMerge, PartsOfIntegerFramesGiveTheWholesBits)
{
  SimulationSettings simulation = SettingsOf(0.05, 30);
  simulation.rollingShutterPeriodRows = 40.0;
  const auto rolling = sensornoise::test::Simulate<GreyValue>(simulation, 64, 56, MakeBarsScene(64, 56));
  for (const auto & settings : { WithGlobalShutter(), ByRow() })
  {
    const auto & stack = settings.rollingShutter == RollingShutter::Off ? FlickeringStack() : rolling;
    const auto   whole = Measure(stack, settings);
    ASSERT_EQ(whole.GetCorrectedVariance().size(), stack.width * stack.height);
    ASSERT_EQ(whole.GetReport().flickerRows.empty(), settings.rollingShutter == RollingShutter::Off);
    for (const std::size_t count : { 2, 3 })
    {
      for (const auto & method : MeasureInTurn(stack, settings, count))
      {
        EXPECT_EQ(ToJson(method.GetReport()), ToJson(whole.GetReport()));
        EXPECT_TRUE(HaveSameBits(method.GetCorrectedVariance(), whole.GetCorrectedVariance()));
      }
    }
  }
}

TEST(SensorNoisePublishedMethodMerge, SumsThatAreForgottenLeaveNothing)
{
  const auto & stack = FlickeringStack();
  const auto   whole = Measure(stack);
  auto         method = MethodOf(stack, {});
  for (unsigned int pass = 0; pass < method.NumberOfPasses; ++pass)
  {
    method.AddFrames(stack.Frame(3), 20);
    method.ForgetSums();
    method.AddFrames(stack.Frame(0), stack.frames);
    method.EndPass();
  }
  EXPECT_EQ(ToJson(method.GetReport()), ToJson(whole.GetReport()));
  EXPECT_TRUE(HaveSameBits(method.GetCorrectedVariance(), whole.GetCorrectedVariance()));
}

TEST(SensorNoisePublishedMethodMerge, SumsOfAnotherStartAreRefused)
{
  const auto & stack = FlickeringStack();
  auto         one = MethodOf(stack, {});
  auto         other = MethodOf(stack, {});
  one.AddFrames(stack.Frame(0), stack.frames);
  other.AddFrames(stack.Frame(0), 2); // another order: other frames
  other.AddFrames(stack.Frame(1), stack.frames - 2);
  one.EndPass();
  other.EndPass();
  std::stringstream sums;
  other.SaveSums(sums);
  EXPECT_THROW(one.MergeSums(sums), std::runtime_error);
}
