// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_SensorTestHelper_h
#define sensornoise_test_SensorTestHelper_h

#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "helpers/DarkPixelsTestHelper.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

/** \file
 * Stacks of camera B (1 DN/e-, 100 DN, 8 DN) with flaws, illuminated and dark. */

namespace sensornoise::test::sensor
{

using GreyValue = unsigned short;

/** Returns a camera without vibration, with flicker of 2 %. */
inline SimulationSettings
StaticCamera(std::size_t frames, std::uint64_t seed = 21)
{
  SimulationSettings settings;
  settings.conditions = { 0.02, 0.0, 0.0 };
  settings.frames = frames;
  settings.seed = seed;
  return settings;
}

/** Returns a scene of one level, with a shading of \a shading towards the corners; one dark pixel spans the range,
 * which the simulator spreads to its electrons. */
inline std::vector<double>
FlatScene(std::size_t size, double shading = 0.0)
{
  std::vector<double> scene(size * size);
  const auto          half = 0.5 * static_cast<double>(size - 1);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    const double x = static_cast<double>(p % size) / half - 1.0;
    const double y = static_cast<double>(p / size) / half - 1.0;
    scene[p] = 1.0 - 0.5 * shading * (x * x + y * y);
  }
  scene[0] = 0.0;
  return scene;
}

/** Returns as many dark frames of the same camera. */
inline Stack<GreyValue>
DarkFramesOf(SimulationSettings settings, std::size_t size)
{
  settings.isDark = true;
  return Simulate<GreyValue>(settings, size, size);
}

inline RefinedSettings
WithDarkFrames(const Stack<GreyValue> & dark)
{
  RefinedSettings settings;
  settings.offset = MeasureDarkStack(dark);
  return settings;
}

/** Expects that the interval of a quantity holds the truth. */
inline void
ExpectHolds(const Quantity & quantity, double truth)
{
  ASSERT_EQ(quantity.status, EstimateStatus::Identified);
  ASSERT_TRUE(quantity.interval95 && quantity.interval95->low && quantity.interval95->high);
  EXPECT_LE(*quantity.interval95->low, truth);
  EXPECT_GE(*quantity.interval95->high, truth);
}

/** Returns the mean of the local gain over the frame [DN/e-]. */
inline double
MeanLocalGain(const StackSimulator & simulator)
{
  const std::size_t pixels = simulator.GetWidth() * simulator.GetHeight();
  double            sum = 0.0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    sum += simulator.LocalGainAt(p);
  }
  return sum / static_cast<double>(pixels);
}

} // namespace sensornoise::test::sensor

#endif
