// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "helpers/PublishedTestHelper.h"
#include "published/PublishedPasses.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

// Causes of the warnings of the published method; without the cause the same stack gives no warning.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns columns of grey levels. The lower half of the rows has the fraction \a lower of the signal. */
Report
ReportOfHalves(double lower)
{
  constexpr std::size_t size = 96;
  std::vector<double>   scene(size * size);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    scene[p] = static_cast<double>(p % size / 16) / 5.0 * (p / size < size / 2 ? 1.0 : lower);
  }
  SimulationSettings settings = SettingsOf(0.05, 40);
  settings.rollingShutterPeriodRows = 40.0;
  return Measure(Simulate<GreyValue>(settings, size, size, scene)).GetReport();
}

/** Returns the report of small frames whose columns have these levels, or a ramp if there are none. */
Report
ReportOfLevels(const std::vector<double> & levels)
{
  constexpr std::size_t width = 48;
  constexpr std::size_t height = 32;
  std::vector<double>   scene(width * height);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    scene[p] = levels.empty() ? static_cast<double>(p % width * height + p / width) / static_cast<double>(scene.size())
                              : levels[p % width * levels.size() / width];
  }
  return Measure(Simulate<GreyValue>(SettingsOf(0.05, 40), width, height, scene)).GetReport();
}
} // namespace

TEST(SensorNoisePublishedWarnings, LinesWithoutFlicker)
{
  const Report half = ReportOfHalves(0.4);
  EXPECT_TRUE(HasWarning(half, WarningCode::RollingShutter)) << MakeText(half);
  EXPECT_TRUE(HasWarning(half, WarningCode::LinesWithoutFlicker)) << MakeText(half);
  const Report whole = ReportOfHalves(1.0);
  EXPECT_TRUE(HasWarning(whole, WarningCode::RollingShutter)) << MakeText(whole);
  EXPECT_FALSE(HasWarning(whole, WarningCode::LinesWithoutFlicker)) << MakeText(whole);
}

TEST(SensorNoisePublishedWarnings, OffsetAboveDarkest)
{
  PolynomialFit line;
  line.isDetermined = true;
  line.slope = 0.5;
  line.intercept = -11.0; // sigma^2 = 0 at 22 DN
  Report report;
  FileParameters(report, EstimateParameters(line, 61.0, 60.0));
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetAboveDarkest));
  Report below;
  FileParameters(below, EstimateParameters(line, 59.0, 60.0));
  EXPECT_TRUE(below.warnings.empty());
}

TEST(SensorNoisePublishedWarnings, PoorFit)
{
  const auto reportOf = [](double reducedChi2) {
    Report        report;
    PolynomialFit line;
    line.isDetermined = true;
    line.slope = 0.5;
    FitQuality quality;
    quality.reducedChi2 = reducedChi2;
    FileParameters(report, EstimateParameters(line, std::nullopt, std::nullopt, quality));
    return report;
  };
  EXPECT_TRUE(reportOf(1.5).warnings.empty());
  EXPECT_TRUE(HasWarning(reportOf(1.6), WarningCode::PoorFit));
  EXPECT_TRUE(HasWarning(reportOf(10.0), WarningCode::PoorFit));
  EXPECT_TRUE(HasWarning(reportOf(10.1), WarningCode::VarianceNotAffine));
}

TEST(SensorNoisePublishedWarnings, SetsWidened)
{
  const Report report = ReportOfLevels({}); // no level has many pixels
  EXPECT_TRUE(HasWarning(report, WarningCode::BrightSetWidened)) << MakeText(report);
  EXPECT_TRUE(HasWarning(report, WarningCode::DarkSetWidened)) << MakeText(report);
  const Report broad = ReportOfLevels({ 0.0, 0.5, 1.0 });
  EXPECT_FALSE(HasWarning(broad, WarningCode::BrightSetWidened)) << MakeText(broad);
  EXPECT_FALSE(HasWarning(broad, WarningCode::DarkSetWidened)) << MakeText(broad);
}

TEST(SensorNoisePublishedWarnings, OffsetLineMisfit)
{
  // A second lamp illuminates the dark areas.
  const SimulationSettings settings = SettingsOf(0.05, 40);
  Stack<GreyValue>         stack = Simulate(settings);
  EXPECT_FALSE(HasWarning(Measure(stack).GetReport(), WarningCode::OffsetLineMisfit));
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    const auto t = static_cast<double>(i / (stack.width * stack.height));
    if (stack.pixels[i] < 500)
    {
      stack.pixels[i] = static_cast<GreyValue>(stack.pixels[i] + std::lround(20.0 + 20.0 * std::sin(2.3 * t)));
    }
  }
  const Report report = Measure(stack).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetLineMisfit)) << MakeText(report);
}
