// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/SensorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

// Reports of sensors that deviate from the model, and of scenes that determine too little.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 128;

SimulationSettings
NonlinearCamera(ResponseShape shape, double nonlinearity, std::size_t frames)
{
  SimulationSettings settings = StaticCamera(frames);
  settings.flaws.response = { shape, nonlinearity };
  return settings;
}

/** Returns a target whose darkest level has the fraction \a low of the signal of the brightest. One pixel without
 * signal spans the range. */
Stack<GreyValue>
SimulateLevels(double low)
{
  std::vector<double> scene = ScaleToRange(MakeTargetScene(Size, Size), low, 1.0);
  scene[0] = 0.0;
  return Simulate<GreyValue>(StaticCamera(40), Size, Size, scene);
}
} // namespace

TEST(SensorNoiseRefinedReport, FlatIsOneIntensityAndNotAThingThatMoves)
{
  for (const double flickerSd : { 0.0, 0.003 })
  {
    SimulationSettings settings = StaticCamera(40);
    settings.conditions.flickerSd = flickerSd;
    const Report report = Measure(Simulate<GreyValue>(settings, Size, Size, FlatScene(Size)), {}).GetReport();
    EXPECT_FALSE(report.gain.value);
    EXPECT_EQ(report.gain.status, EstimateStatus::NotIdentifiable);
    EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
    EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
    EXPECT_TRUE(HasWarning(report, WarningCode::IntensityRangeTooSmall)) << ToJson(report);
    EXPECT_FALSE(HasWarning(report, WarningCode::NotStatic));
    EXPECT_FALSE(HasWarning(report, WarningCode::VarianceNotAffine));
    ASSERT_TRUE(report.fit.line);
  }
}

TEST(SensorNoiseRefinedReport, NarrowRangeLeavesTheResponseUnchecked)
{
  const Report narrow = Measure(SimulateLevels(0.3), {}).GetReport();
  EXPECT_TRUE(HasWarning(narrow, WarningCode::ResponseUnchecked)) << ToJson(narrow);
  EXPECT_NEAR(ValueOf(narrow.gain), 1.0, 5.0 * *narrow.gain.standardError);
  const Report full = Measure(SimulateLevels(0.0), {}).GetReport();
  EXPECT_FALSE(HasWarning(full, WarningCode::ResponseUnchecked));
}

TEST(SensorNoiseRefinedReport, NonlinearResponseHasTheMeanGainInItsInterval)
{
  constexpr std::size_t size = 192;
  for (const double nonlinearity : { 0.04, -0.04 })
  {
    const SimulationSettings settings = NonlinearCamera(ResponseShape::Quadratic, nonlinearity, 40);
    const StackSimulator     simulator(MakeTargetScene(size, size), size, size, settings);
    const Report             report = Measure(Simulate<GreyValue>(settings, size, size), {}).GetReport();
    EXPECT_TRUE(HasWarning(report, WarningCode::ResponseNotStraight)) << nonlinearity;
    EXPECT_FALSE(HasWarning(report, WarningCode::VarianceNotAffine)) << nonlinearity;
    EXPECT_FALSE(HasWarning(report, WarningCode::NotStatic)) << nonlinearity;
    ExpectHolds(report.gain, MeanLocalGain(simulator));
    EXPECT_LT(*report.gain.standardError, 0.04);
    // The matrix contains the same errors, with the error of the model.
    ASSERT_TRUE(report.covariance);
    EXPECT_NEAR(std::sqrt((*report.covariance)[0][0]) / *report.gain.standardError, 1.0, 1e-9);
    EXPECT_NEAR(std::sqrt((*report.covariance)[1][1]) / *report.totalIntercept.standardError, 1.0, 1e-6);
    ASSERT_TRUE(report.fit.nonlinearity);
    EXPECT_GT(*report.fit.nonlinearity, 0.01);
    EXPECT_LT(*report.fit.nonlinearity, 0.12);
  }
}

TEST(SensorNoiseRefinedReport, VerdictOnANonlinearityDoesNotDependOnTheSizeOfTheFrame)
{
  // With sixteen times the pixels the non-linearity is more significant, not larger.
  const SimulationSettings settings = NonlinearCamera(ResponseShape::Quadratic, 0.04, 20);
  const Report             small = Measure(Simulate<GreyValue>(settings, 128, 128), {}).GetReport();
  const StackSimulator     simulator(MakeTargetScene(512, 512), 512, 512, settings);
  const Report             large = Measure(Simulate<GreyValue>(settings, 512, 512), {}).GetReport();
  EXPECT_EQ(small.gain.status, large.gain.status);
  EXPECT_TRUE(HasWarning(small, WarningCode::ResponseNotStraight));
  EXPECT_TRUE(HasWarning(large, WarningCode::ResponseNotStraight));
  ExpectHolds(large.gain, MeanLocalGain(simulator));
  // In the small frame two errors are subtracted as chance, 1 % each in a sixteenth of the pixels.
  EXPECT_NEAR(*small.fit.nonlinearity, *large.fit.nonlinearity, 0.03);
}

TEST(SensorNoiseRefinedReport, ToneCurveIsRefusedWithItsLine)
{
  for (const auto & [shape, size] : { std::pair{ ResponseShape::Gamma, 1.3 }, std::pair{ ResponseShape::Gamma, 2.2 } })
  {
    const Report report = Measure(Simulate<GreyValue>(NonlinearCamera(shape, size, 40), Size, Size), {}).GetReport();
    EXPECT_EQ(report.gain.status, EstimateStatus::Failed) << size;
    EXPECT_FALSE(report.gain.value || report.offset.value || report.readNoise.value) << size;
    EXPECT_TRUE(HasWarning(report, WarningCode::VarianceNotAffine)) << size;
    ASSERT_TRUE(report.fit.line) << size;
    EXPECT_TRUE(std::isfinite(report.fit.line->gain) && std::isfinite(report.fit.line->intercept)) << size;
    EXPECT_NE(ToJson(report).find("\"line\""), std::string::npos);
  }
}

TEST(SensorNoiseRefinedReport, ToneCurveIsNotTakenForSharpEdges)
{
  // The pixels that the initial model leaves out are at the edges, as where edges are sharper than a pixel.
  SimulationSettings settings; // it flickers and vibrates
  settings.frames = 60;
  settings.flaws.response = { ResponseShape::Gamma, 0.6 };
  const Report report = Measure(Simulate<GreyValue>(settings, 256, 192), {}).GetReport();
  EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
}

TEST(SensorNoiseRefinedReport, ToneCurveIsRefusedHoweverManyPixelsShowIt)
{
  // With more pixels the roughness classes differ beyond chance. This must not hide the curve.
  Stack<GreyValue> stack = Simulate<GreyValue>(SimulationSettings(), 512, 512); // 100 frames
  for (GreyValue & greyValue : stack.pixels)
  {
    greyValue =
      static_cast<GreyValue>(std::lround(4095.0 * std::pow(static_cast<double>(greyValue) / 4095.0, 1.0 / 1.3)));
  }
  const Report report = Measure(stack, {}).GetReport();
  EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
  EXPECT_TRUE(HasWarning(report, WarningCode::VarianceNotAffine));
}

TEST(SensorNoiseRefinedReport, FloatingPointFramesThatSaturateAreMeasuredAsTheirIntegers)
{
  SimulationSettings settings = StaticCamera(40);
  settings.clipHighDn = 2000.0; // the largest levels are about 3,100
  const Stack<GreyValue> greyValues = Simulate<GreyValue>(settings, Size, Size);
  const Report           integer = Measure(greyValues, {}).GetReport();
  const Report           floating = Measure(greyValues.Map<float>([](GreyValue u) { return u; }), {}).GetReport();
  EXPECT_TRUE(HasWarning(floating, WarningCode::ClipLevelFound));
  EXPECT_NEAR(ValueOf(integer.gain), 1.0, 5.0 * *integer.gain.standardError);
  EXPECT_NEAR(ValueOf(floating.gain), ValueOf(integer.gain), 0.5 * *integer.gain.standardError);
  EXPECT_EQ(floating.clipHighDn, integer.clipHighDn);
  EXPECT_NEAR(static_cast<double>(floating.pixels.clipped),
              static_cast<double>(integer.pixels.clipped),
              0.01 * static_cast<double>(integer.pixels.clipped));
}
