// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <gtest/gtest.h>
#include <string>
#include <variant>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;

/** Exposures 1, 2, 3, 4, 5 of frame after frame: the levels of the stack do not follow them. */
std::vector<double>
AnyExposures(unsigned int frames)
{
  std::vector<double> exposures;
  for (unsigned int t = 0; t < frames; ++t)
  {
    exposures.push_back(1.0 + t % 5);
  }
  return exposures;
}

std::string
SettingErrorOf(const std::vector<double> & exposures, const std::string & method = "refined")
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack(), method);
  try
  {
    estimator->SetExposures(exposures);
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return ErrorOf(estimator);
}
} // namespace

TEST(SensorNoiseEstimatorExposures, NoneByDefault)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  EXPECT_TRUE(estimator->GetExposures().empty());
  ASSERT_EQ(ErrorOf(estimator), "no error");
  EXPECT_EQ(estimator->GetReport().linearity.reason, "no exposures were given");
}

TEST(SensorNoiseEstimatorExposures, ReachTheMethodAndTheSettings)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetExposures(AnyExposures(Frames));
  ASSERT_EQ(ErrorOf(estimator), "no error");
  const sensornoise::Report & report = estimator->GetReport();
  EXPECT_EQ(report.linearity.levels.size(), 5u);
  EXPECT_EQ(report.settings.at(1).first, "exposures");
  EXPECT_EQ(std::get<std::vector<double>>(report.settings.at(1).second), AnyExposures(Frames));
  const auto modified = estimator->GetMTime();
  estimator->SetExposures(AnyExposures(Frames));
  EXPECT_EQ(estimator->GetMTime(), modified);
}

TEST(SensorNoiseEstimatorExposures, OfAMosaicEveryChannelHasThem)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetBayerPattern("RGGB");
  estimator->SetExposures(AnyExposures(Frames));
  ASSERT_EQ(ErrorOf(estimator), "no error");
  for (const sensornoise::Report & channel : estimator->GetChannelReports().channels)
  {
    EXPECT_EQ(channel.linearity.levels.size(), 5u);
  }
}

TEST(SensorNoiseEstimatorExposures, WrongUseIsRefused)
{
  EXPECT_SAYS(SettingErrorOf({ 1.0, 2.0, 3.0 }), "there are 3 exposures, but 25 frames");
  EXPECT_SAYS(SettingErrorOf({ 1.0, 2.0, -3.0 }), "the exposure of frame 2 is -3");
  EXPECT_SAYS(SettingErrorOf(AnyExposures(Frames), "published"), "exposures cannot be used by the method published");
  EXPECT_SAYS(SettingErrorOf(AnyExposures(Frames), "published"), "set the method to refined");
}
