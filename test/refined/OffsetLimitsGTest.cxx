// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SensorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

// Bounds of an offset that the flicker does not determine.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 96;
constexpr std::size_t Frames = 25;

Report
ReportOf(char camera, double flickerSd, std::uint64_t seed)
{
  SimulationSettings settings = StaticCamera(Frames, seed);
  settings.camera = PaperCamera(camera);
  settings.conditions.flickerSd = flickerSd;
  return Measure(Simulate<GreyValue>(settings, Size, Size), {}).GetReport();
}
} // namespace

TEST(SensorNoiseOffsetLimits, WithoutFlickerTheBoundsHoldTheTruth)
{
  // Each bound holds with at least 97.5 %: one of 24 stacks may violate it by chance (three or more: p < 0.02).
  int held = 0;
  int stacks = 0;
  for (const char camera : { 'A', 'B', 'C' })
  {
    const CameraModel truth = PaperCamera(camera);
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
    {
      const Report report = ReportOf(camera, 0.0, seed);
      ASSERT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
      ASSERT_TRUE(report.offset.bracket && report.offset.bracket->low && report.offset.bracket->high);
      const double low = *report.offset.bracket->low;
      const double high = *report.offset.bracket->high;
      ++stacks;
      held += low <= truth.offsetDn && truth.offsetDn <= high ? 1 : 0;
      // The lower bound is sigma^2 / g below the offset, and the darkest level is dark: the bounds are close.
      const double readWidthDn = truth.readNoiseDn * truth.readNoiseDn / truth.gainDnPerElectron;
      EXPECT_LT(high - low, 2.0 * readWidthDn + 0.02 * truth.gainDnPerElectron * truth.electrons) << camera << seed;
      ASSERT_TRUE(report.readNoise.bracket && report.readNoise.bracket->high);
      EXPECT_EQ(*report.readNoise.bracket->low, 0.0);
      EXPECT_GE(*report.readNoise.bracket->high, truth.readNoiseDn) << camera << seed;
      EXPECT_GE(*report.readNoiseElectrons.bracket->high, 0.95 * truth.readNoiseDn / truth.gainDnPerElectron);
    }
  }
  EXPECT_GE(held, stacks - 1);
}

TEST(SensorNoiseOffsetLimits, IdentifiedOffsetIsWithinItsBounds)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    const Report report = ReportOf('B', 0.05, seed);
    const double offsetDn = ValueOf(report.offset);
    ASSERT_TRUE(report.offset.bracket && report.offset.bracket->low && report.offset.bracket->high);
    EXPECT_LE(*report.offset.bracket->low, offsetDn - *report.offset.standardError) << seed;
    EXPECT_GE(*report.offset.bracket->high, offsetDn + *report.offset.standardError) << seed;
    EXPECT_NEAR(offsetDn, 100.0, 5.0 * *report.offset.standardError) << seed;
  }
}
