// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/SensorTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <sstream>

// Companded data: `gain` is the gain of the sensor, and `variance_slope` contains the quantization noise.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 160;
constexpr std::size_t Frames = 40;

test::Stack<unsigned short>
SimulateCompanded(unsigned int bits, double gain, double readNoiseDn = 8.0)
{
  SimulationSettings settings;
  settings.camera.gainDnPerElectron = gain;
  settings.camera.readNoiseDn = readNoiseDn;
  settings.camera.electrons = 3300.0 / gain;
  settings.frames = Frames;
  settings.seed = 7;
  settings.flaws.companding.bits = bits;
  return Simulate<unsigned short>(settings, Size, Size, MakeTextureScene(Size, Size));
}
} // namespace

TEST(SensorNoiseCompandedData, GainIsTheSensorsAndTheSlopeContainsTheQuantization)
{
  for (const unsigned int bits : { 8U, 10U })
  {
    const double gain = bits == 8 ? 1.0 : 0.1;
    const Report report = Measure(SimulateCompanded(bits, gain), {}).GetReport();
    ASSERT_TRUE(report.gain.value) << ToJson(report);
    EXPECT_TRUE(HasWarning(report, WarningCode::Companded));
    const double error = *report.gain.standardError;
    EXPECT_LT(error, 0.005 * gain);
    EXPECT_NEAR(*report.gain.value, gain, 3.0 * error) << bits;
    // The step near level v is 2 sqrt(4095 v) / (2^bits - 1): its square over 12 has this slope.
    const double top = std::exp2(bits) - 1.0;
    const double ofQuantisation = 4.0 * 4095.0 / (12.0 * top * top);
    EXPECT_GT(ofQuantisation, 3.0 * error); // otherwise nothing is tested
    EXPECT_NEAR(*report.varianceSlope.value - *report.gain.value, ofQuantisation, 0.05 * ofQuantisation);
    EXPECT_NEAR(*report.readNoise.value, 8.0, 4.0 * *report.readNoise.standardError);
  }
}

TEST(SensorNoiseCompandedData, EvenStepsHaveOneSlope)
{
  const Report report = Measure(SimulateCompanded(0, 1.0), {}).GetReport();
  EXPECT_FALSE(HasWarning(report, WarningCode::Companded));
  EXPECT_EQ(report.varianceSlope.value, report.gain.value);
  EXPECT_EQ(report.varianceSlope.standardError, report.gain.standardError);
  EXPECT_EQ(*report.totalIntercept.value - 1.0 / 12.0, *report.intercept.value);
}

TEST(SensorNoiseCompandedData, SameBitsForAnyChunksAndParts)
{
  const auto                    stack = SimulateCompanded(8, 1.0);
  const auto                    whole = Measure(stack, {});
  const auto                    chunks = Measure(stack, {}, 7);
  RefinedMethod<unsigned short> parts[2] = { { {}, GeometryOf(stack), Frames }, { {}, GeometryOf(stack), Frames } };
  while (!parts[0].IsDone())
  {
    std::stringstream sums[2];
    parts[0].AddFrames(stack.Frame(0), 15);
    parts[0].SkipFrames(Frames - 15);
    parts[1].SkipFrames(15);
    parts[1].AddFrames(stack.Frame(15), Frames - 15);
    parts[0].SaveSums(sums[0]);
    parts[1].SaveSums(sums[1]);
    parts[0].MergeSums(sums[1]);
    parts[1].MergeSums(sums[0]);
    parts[0].EndPass();
    parts[1].EndPass();
  }
  ASSERT_TRUE(HasWarning(whole.GetReport(), WarningCode::Companded));
  for (const auto * method : { &chunks,
                               static_cast<const RefinedMethod<unsigned short> *>(&parts[0]),
                               static_cast<const RefinedMethod<unsigned short> *>(&parts[1]) })
  {
    EXPECT_EQ(ToJson(method->GetReport()), ToJson(whole.GetReport()));
  }
}

TEST(SensorNoiseCompandedData, TooCoarseInTheDarkIsRefused)
{
  const Report report = Measure(SimulateCompanded(6, 0.2), {}).GetReport();
  EXPECT_FALSE(report.gain.value);
  EXPECT_TRUE(HasWarning(report, WarningCode::CodesTooCoarse)) << ToJson(report);
}

TEST(SensorNoiseCompandedData, TooCoarseWhereBrightIsLeftOut)
{
  const auto   stack = SimulateCompanded(7, 0.05, 15.0);
  const auto   method = Measure(stack, {});
  const Report report = method.GetReport();
  EXPECT_FALSE(HasWarning(report, WarningCode::CodesTooCoarse)) << ToJson(report);
  std::size_t coarse = 0;
  std::size_t usedWhereBright = 0;
  for (std::size_t p = 0; p < Size * Size; ++p)
  {
    const auto use = static_cast<PixelUse>(method.GetPixelUse()[p]);
    coarse += use == PixelUse::CoarseQuantisation ? 1 : 0;
    // The step is 49 DN, and the noise 18.6 DN. The mean of the neighbours decides, so that pixels at edges are used.
    usedWhereBright += method.GetMean()[p] > 2400.0 && use == PixelUse::Used ? 1 : 0;
  }
  EXPECT_LT(usedWhereBright, coarse / 20);
  EXPECT_GT(coarse, 100u);
  ASSERT_TRUE(report.gain.value) << ToJson(report);
  EXPECT_NEAR(*report.gain.value, 0.05, 3.0 * *report.gain.standardError);
}
