// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "simulation/Random.h"
#include "helpers/DarkPixelsTestHelper.h"
#include "helpers/RefinedTestHelper.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

// Noise that the pixels of a frame have in common: in the frames, in the dark frames, or in both. Camera B: g = 1
// DN/e-, mu = 100 DN, sigma = 8 DN.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 160;
using GreyValue = unsigned short;

struct Settings
{
  std::size_t frames{ 40 };
  double      electrons{ 2000.0 };
  double      slope{ 0.0 };          ///< relative change of the signal across the frame
  double      fieldFlickerSd{ 0.0 }; ///< standard deviation, independent in even and odd rows
  double      stripesDn{ 0.0 };      ///< rms of diagonal stripes
  unsigned    seed{ 1 };
};

Stack<GreyValue>
Make(const Settings & settings)
{
  Stack<GreyValue> stack{ Size, Size, settings.frames, std::vector<GreyValue>(Size * Size * settings.frames) };
  const double     cycle = 2.0 * std::acos(-1.0);
  for (std::size_t t = 0; t < settings.frames; ++t)
  {
    CounterSeededRandom         random(settings.seed, 9, t);
    const std::array<double, 2> fields{ 1.0 + settings.fieldFlickerSd * random.Normal(),
                                        1.0 + settings.fieldFlickerSd * random.Normal() };
    const double                phase = cycle * random.Uniform();
    for (std::size_t p = 0; p < Size * Size; ++p)
    {
      const auto   x = static_cast<double>(p % Size);
      const auto   y = static_cast<double>(p / Size);
      const double signal = settings.electrons * (1.0 + settings.slope * (x / Size - 0.5)) * fields[p / Size % 2];
      const double stripes = std::sqrt(2.0) * settings.stripesDn * std::sin(cycle * (0.173 * x + 0.091 * y) + phase);
      const double value = static_cast<double>(random.Poisson(signal)) + 100.0 + 8.0 * random.Normal() + stripes;
      stack.pixels[t * Size * Size + p] = static_cast<GreyValue>(std::lround(value));
    }
  }
  return stack;
}

Report
ReportOf(const Settings & bright, const Settings & dark)
{
  RefinedSettings settings;
  settings.offset = MeasureDarkStack(Make(dark));
  return Measure(Make(bright), settings).GetReport();
}

void
ExpectTruth(const Quantity & quantity, double truth, double largestError)
{
  ASSERT_EQ(quantity.status, EstimateStatus::Identified);
  EXPECT_NEAR(*quantity.value, truth, 4.0 * *quantity.standardError);
  EXPECT_LT(*quantity.standardError, largestError);
}
} // namespace

// The rows of both fields flicker independently: a variance of the illumination that the dark frames lack. It is 40 %
// of the shot noise.
TEST(SensorNoiseStructuredDarkNoise, LightOfFlatFieldsIsNotInTheDarkFrames)
{
  Settings flat;
  flat.fieldFlickerSd = 0.02;
  const Report report = ReportOf(flat, { 20, 0.0, 0.0, 0.0, 0.0, 2 });
  ExpectTruth(report.gain, 1.0, 0.02);
  ExpectTruth(report.readNoise, 8.0, 0.05);
}

// Stripes of 4 DN, in shot noise of 45 DN, are not found in the frames alone.
TEST(SensorNoiseStructuredDarkNoise, StripesOfTheDarkFramesAreNoReadNoise)
{
  Settings bright;
  bright.slope = 1.6;
  bright.stripesDn = 4.0;
  const Report report = ReportOf(bright, { 20, 0.0, 0.0, 0.0, 4.0, 2 });
  ExpectTruth(report.gain, 1.0, 0.02);
  ExpectTruth(report.readNoise, 8.0, 0.05);
  ASSERT_TRUE(report.noiseCorrelation);
}

TEST(SensorNoiseStructuredDarkNoise, AFailedReportHasTheReadNoiseWithoutThem)
{
  RefinedSettings settings;
  settings.offset = KnownOffset{ 100.0, 0.1, 20, DarkVariance{ 80.0, 0.1 } };
  settings.offset->structured = StructuredNoise{ { 16.0, 0.2 }, {} };
  EXPECT_DOUBLE_EQ(WithoutStructuredNoise(settings).offset->variance->valueDn2, 64.0);
  settings.offset->structured->variance = { 0.3, 0.2 }; // not significant
  EXPECT_DOUBLE_EQ(WithoutStructuredNoise(settings).offset->variance->valueDn2, 80.0);
  settings.offset->structured.reset();
  EXPECT_DOUBLE_EQ(WithoutStructuredNoise(settings).offset->variance->valueDn2, 80.0);
}

// Rounding hides less than half a step in the frames, and a filter has reduced the noise of the sensor before.
TEST(SensorNoiseStructuredDarkNoise, LimitOfTheReadNoiseIsBeforeTheFilter)
{
  RefinedSettings settings;
  settings.offset = KnownOffset{ 100.0, 0.1, 20, DarkVariance{ 0.6, 0.01 } };
  const double step = 1.0 / 12.0;
  const auto   limitOf = [&](double factor) {
    return QuantitiesOfDarkFrames(settings, step, EstimateStatus::Failed, factor).readNoise;
  };
  EXPECT_EQ(limitOf(1.0).status, EstimateStatus::Identified);
  ASSERT_EQ(limitOf(4.0).status, EstimateStatus::UpperLimit);
  EXPECT_DOUBLE_EQ(*limitOf(4.0).bracket->high, 1.0); // half a step, times the root of the factor
}
