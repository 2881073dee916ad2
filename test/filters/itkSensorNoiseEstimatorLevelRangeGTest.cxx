// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkNumericTraits.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <variant>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using sensornoise::PixelUse;
using Limits = itk::NumericTraits<double>;

template <typename TEstimator>
long
CountOutside(const TEstimator & estimator)
{
  const auto uses = PixelsOf(estimator->GetPixelUse());
  return std::count(uses.begin(), uses.end(), static_cast<unsigned char>(PixelUse::OutsideRange));
}

/** NaN: the report has no such setting. */
double
SettingOf(const sensornoise::Report & report, const std::string & name)
{
  for (const auto & setting : report.settings)
  {
    if (setting.first == name)
    {
      return std::get<double>(setting.second);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}
} // namespace

TEST(SensorNoiseEstimatorLevelRange, AllLevelsByDefault)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  EXPECT_EQ(estimator->GetLevelRangeLow(), Limits::NonpositiveMin());
  EXPECT_EQ(estimator->GetLevelRangeHigh(), Limits::max());
  const std::string json = JsonOf(estimator);
  EXPECT_EQ(json.find("level_range"), std::string::npos);
  EXPECT_EQ(CountOutside(estimator), 0);
  estimator->SetLevelRangeLow(Limits::NonpositiveMin());
  estimator->SetLevelRangeHigh(Limits::max());
  EXPECT_EQ(JsonOf(estimator), json);
}

TEST(SensorNoiseEstimatorLevelRange, LeavesOutTheOtherLevels)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetLevelRangeLow(500.0);
  estimator->SetLevelRangeHigh(2500.0);
  ASSERT_EQ(ErrorOf(estimator), "no error");
  EXPECT_EQ(SettingOf(estimator->GetReport(), "level_range_low"), 500.0);
  EXPECT_EQ(SettingOf(estimator->GetReport(), "level_range_high"), 2500.0);
  EXPECT_GT(CountOutside(estimator), 100);
}

// Each end by itself leaves out some, and both together leave out the pixels of either.
TEST(SensorNoiseEstimatorLevelRange, OneEndMayBeOpen)
{
  const auto outside = [](double low, double high) {
    const auto estimator = EstimatorOf<StackType>(SimulatedStack());
    estimator->SetLevelRangeLow(low);
    estimator->SetLevelRangeHigh(high);
    EXPECT_EQ(ErrorOf(estimator), "no error");
    return CountOutside(estimator);
  };
  const long below = outside(500.0, Limits::max());
  const long above = outside(Limits::NonpositiveMin(), 2500.0);
  EXPECT_GT(below, 50);
  EXPECT_GT(above, 50);
  EXPECT_EQ(outside(500.0, 2500.0), below + above);
}

TEST(SensorNoiseEstimatorLevelRange, WrongUseIsRefused)
{
  const auto errorOf = [](double low, double high, const std::string & method) {
    const auto estimator = EstimatorOf<StackType>(SimulatedStack(), method);
    estimator->SetLevelRangeLow(low);
    estimator->SetLevelRangeHigh(high);
    return ErrorOf(estimator);
  };
  EXPECT_SAYS(errorOf(2500.0, 500.0, "refined"), "from 2500");
  EXPECT_SAYS(errorOf(2500.0, 500.0, "refined"), "expected the lower level first");
  EXPECT_SAYS(errorOf(std::numeric_limits<double>::quiet_NaN(), 500.0, "refined"), "expected the lower level first");
  EXPECT_SAYS(errorOf(500.0, 2500.0, "published"),
              "a range of levels cannot be used by the method published, which fits all levels");
  EXPECT_SAYS(errorOf(500.0, 2500.0, "published"), "set the method to refined");
}
