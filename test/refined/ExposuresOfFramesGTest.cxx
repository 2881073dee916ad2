// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// RefinedSettings::exposures: the linearity of the response.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;

/** Returns six exposures of four frames each, after two dark frames. */
std::vector<double>
ExposuresOfBurst()
{
  std::vector<double> exposures{ 0.0, 0.0 };
  for (const double exposure : { 0.15, 0.3, 0.45, 0.6, 0.8, 1.0 })
  {
    exposures.insert(exposures.end(), 4, exposure);
  }
  return exposures;
}

Stack<GreyValue>
Burst(double nonlinearity)
{
  SimulationSettings settings;
  settings.camera = { 7000.0, 0.5, 100.0, 3.0 };
  settings.conditions = { 0.001, 0.0, 0.0 };
  settings.illumination.shape = IlluminationShape::Factors;
  settings.illumination.factors = ExposuresOfBurst();
  settings.frames = settings.illumination.factors.size();
  settings.flaws.response = { ResponseShape::Quadratic, nonlinearity };
  settings.seed = 4;
  return Simulate<GreyValue>(settings, 96, 96);
}

/** Returns the signal u at exposure 1 [1] for its mean level [DN], the root of u + b (u - u^2) = (level - 100) / 3500.
 */
double
BrightestOf(double nonlinearity, double levelDn)
{
  const double b = 1.0 + nonlinearity;
  return (b - std::sqrt(b * b - 4.0 * nonlinearity * (levelDn - 100.0) / 3500.0)) / (2.0 * nonlinearity);
}

/** Returns the linearity error of EMVA 1288 for the response without noise, from the normal equations of its line [%].
 */
double
TrueErrorPercent(double nonlinearity, double brightest)
{
  const std::vector<double> exposures{ 0.15, 0.3, 0.45, 0.6, 0.8, 1.0 };
  const auto                signal = [&](double e) {
    return e * brightest + nonlinearity * (e * brightest - e * e * brightest * brightest);
  };
  double sums[5] = {};
  for (const double e : exposures)
  {
    const double weight = 1.0 / (signal(e) * signal(e));
    sums[0] += weight;
    sums[1] += weight * e;
    sums[2] += weight * e * e;
    sums[3] += weight * signal(e);
    sums[4] += weight * e * signal(e);
  }
  const double determinant = sums[0] * sums[2] - sums[1] * sums[1];
  const double intercept = (sums[2] * sums[3] - sums[1] * sums[4]) / determinant;
  const double slope = (sums[0] * sums[4] - sums[1] * sums[3]) / determinant;
  double       sum = 0.0;
  for (const double e : exposures)
  {
    sum += std::abs(signal(e) / (intercept + slope * e) - 1.0);
  }
  return 100.0 * sum / static_cast<double>(exposures.size());
}

Report
MeasureWith(const Stack<GreyValue> & stack, const std::vector<double> & exposures)
{
  RefinedSettings settings;
  settings.exposures = exposures;
  return Measure(stack, settings).GetReport();
}
} // namespace

TEST(SensorNoiseExposuresOfFrames, ANonlinearResponseHasItsLinearityError)
{
  const Report report = MeasureWith(Burst(0.04), ExposuresOfBurst());
  ASSERT_EQ(report.linearity.errorPercent.status, EstimateStatus::Identified) << report.linearity.reason;
  const double truth = TrueErrorPercent(0.04, BrightestOf(0.04, report.linearity.levels.back().meanDn));
  EXPECT_NEAR(*report.linearity.errorPercent.value, truth, 3.0 * *report.linearity.errorPercent.standardError);
  EXPECT_LT(*report.linearity.errorPercent.standardError, 0.05); // flicker 0.1 %, 4 frames: 0.05 % per level
  EXPECT_NEAR(*report.linearity.offsetDn.value, 100.0, 4.0 * *report.linearity.offsetDn.standardError);
  EXPECT_EQ(report.linearity.levels.size(), 7u);
  EXPECT_EQ(report.linearity.levels[0].frames, 2u);
  EXPECT_EQ(std::get<std::vector<double>>(report.settings.at(1).second), ExposuresOfBurst());
}

TEST(SensorNoiseExposuresOfFrames, AStraightResponseHasAnUpperLimit)
{
  const Report report = MeasureWith(Burst(0.0), ExposuresOfBurst());
  EXPECT_EQ(report.linearity.errorPercent.status, EstimateStatus::UpperLimit);
  EXPECT_LT(*report.linearity.errorPercent.interval95->high, 0.15); // flicker 0.1 %, 4 frames: 0.05 % per level
}

TEST(SensorNoiseExposuresOfFrames, NothingElseChanges)
{
  const auto stack = Burst(0.0);
  Report     with = MeasureWith(stack, ExposuresOfBurst());
  Report     without = MeasureWith(stack, {});
  EXPECT_EQ(without.linearity.reason, "no exposures were given");
  with.linearity = without.linearity;
  with.settings = without.settings;
  EXPECT_EQ(ToJson(with), ToJson(without));
}

TEST(SensorNoiseExposuresOfFrames, RepeatedFramesCountOnce)
{
  Stack<GreyValue>    stack = Burst(0.04);
  std::vector<double> exposures = ExposuresOfBurst();
  const Report        before = MeasureWith(stack, exposures);
  const std::size_t   pixels = stack.width * stack.height;
  stack.pixels.insert(stack.pixels.begin() + static_cast<std::ptrdiff_t>(6 * pixels),
                      stack.pixels.begin() + static_cast<std::ptrdiff_t>(5 * pixels),
                      stack.pixels.begin() + static_cast<std::ptrdiff_t>(6 * pixels));
  ++stack.frames;
  exposures.insert(exposures.begin() + 6, exposures[5]);
  const Report after = MeasureWith(stack, exposures);
  EXPECT_EQ(after.framesDistinct, before.framesDistinct);
  EXPECT_EQ(after.linearity.errorPercent.value, before.linearity.errorPercent.value);
  EXPECT_EQ(after.linearity.levels[1].frames, 4u);
}

TEST(SensorNoiseExposuresOfFrames, TwoProcessesFindTheSame)
{
  const auto      stack = Burst(0.04);
  RefinedSettings settings;
  settings.exposures = ExposuresOfBurst();
  RefinedMethod<GreyValue> first(settings, GeometryOf(stack), stack.frames);
  RefinedMethod<GreyValue> second(settings, GeometryOf(stack), stack.frames);
  while (!first.IsDone())
  {
    first.AddFrames(stack.Frame(0), 11);
    second.SkipFrames(11);
    second.AddFrames(stack.Frame(11), stack.frames - 11);
    std::stringstream sums;
    second.SaveSums(sums);
    std::stringstream others;
    first.SaveSums(others);
    first.MergeSums(sums);
    second.MergeSums(others);
    first.EndPass();
    second.EndPass();
  }
  EXPECT_EQ(ToJson(first.GetReport()), ToJson(MeasureWith(stack, ExposuresOfBurst())));
  EXPECT_EQ(ToJson(first.GetReport()), ToJson(second.GetReport()));
}

TEST(SensorNoiseExposuresOfFrames, WrongOnesAreRefused)
{
  const auto stack = Burst(0.0);
  EXPECT_THROW(MeasureWith(stack, { 1.0, 2.0, 3.0 }), std::invalid_argument);
  EXPECT_THROW(MeasureWith(stack, std::vector<double>(26, 1.0)), std::invalid_argument);
}
