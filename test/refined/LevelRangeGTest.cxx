// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SensorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

// RefinedSettings::levelRangeDn: the variance is fitted between these levels alone.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 128;

RefinedSettings
WithRange(double lowDn, double highDn)
{
  RefinedSettings settings;
  settings.levelRangeDn = LevelRange{ lowDn, highDn };
  return settings;
}
} // namespace

TEST(SensorNoiseLevelRange, PixelsOfOtherLevelsAreLeftOut)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(StaticCamera(40), Size, Size);
  const auto             all = Measure(stack, {});
  const auto             method = Measure(stack, WithRange(300.0, 1500.0));
  const auto &           mean = method.GetMean();
  std::size_t            outside = 0;
  for (std::size_t p = 0; p < mean.size(); ++p)
  {
    double neighbours = -mean[p];
    if (p % Size >= 2 && p % Size < Size - 2 && p / Size >= 2 && p / Size < Size - 2)
    {
      for (std::size_t i = 0; i < 9; ++i)
      {
        neighbours += mean[p + (i / 3) * Size + i % 3 - Size - 1];
      }
      neighbours /= 8.0;
      const bool isOutside = neighbours < 300.0 || neighbours > 1500.0;
      const auto use = method.GetPixelUse()[p];
      const bool isUsable = all.GetPixelUse()[p] == static_cast<std::uint8_t>(PixelUse::Used);
      EXPECT_TRUE(!isUsable || (use == static_cast<std::uint8_t>(PixelUse::OutsideRange)) == isOutside) << p;
      outside += isUsable && isOutside ? 1 : 0;
    }
  }
  EXPECT_GT(outside, Size * Size / 5);
  EXPECT_EQ(static_cast<int>(PixelUse::OutsideRange), 12);
  EXPECT_NEAR(ValueOf(method.GetReport().gain), 1.0, 5.0 * *method.GetReport().gain.standardError);
  EXPECT_GT(*method.GetReport().gain.standardError, *all.GetReport().gain.standardError);
}

TEST(SensorNoiseLevelRange, LinearPartOfANonlinearResponseHasItsOwnGain)
{
  // A shoulder from 60 % on. Below it the gain is 1.04.
  SimulationSettings settings = StaticCamera(40);
  settings.flaws.response = { ResponseShape::Shoulder, 0.04 };
  const Stack<GreyValue> stack = Simulate<GreyValue>(settings, Size, Size);
  const Report           all = Measure(stack, {}).GetReport();
  const Report           part = Measure(stack, WithRange(0.0, 100.0 + 0.55 * settings.camera.electrons)).GetReport();
  EXPECT_TRUE(HasWarning(all, WarningCode::ResponseNotStraight));
  EXPECT_FALSE(HasWarning(part, WarningCode::ResponseNotStraight));
  EXPECT_NEAR(ValueOf(part.gain), 1.04, 5.0 * *part.gain.standardError);
}

TEST(SensorNoiseLevelRange, RangeOfNoPixelsIsAReportWithAReason)
{
  const Report report =
    Measure(Simulate<GreyValue>(StaticCamera(20), Size, Size), WithRange(50000.0, 60000.0)).GetReport();
  EXPECT_FALSE(report.IsUsable());
  EXPECT_FALSE(report.warnings.empty());
}

TEST(SensorNoiseLevelRange, RangeThatIsNoneIsRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LevelRange & range :
       { LevelRange{ 5.0, 5.0 }, LevelRange{ 6.0, 5.0 }, LevelRange{ nan, 5.0 }, LevelRange{ 5.0, nan } })
  {
    EXPECT_THROW(WithRange(range.lowDn, range.highDn).Validate(), std::invalid_argument);
  }
  EXPECT_NO_THROW(WithRange(5.0, 6.0).Validate());
}
