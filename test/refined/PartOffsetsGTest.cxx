// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/WarningCodes.h"
#include "simulation/Random.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/SensorTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

// Halves of a sensor whose amplifiers differ in their dark offset.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 128;
constexpr std::size_t Frames = 30;
constexpr double      OffsetDn = 100.0;

/** Returns a burst of 1 DN/e- and a read noise of 2 DN, with a flicker of \a flicker rms [1]. The right half has twice
 * the signal of the left half, and the offsets of the halves differ by \a stepDn. */
Stack<GreyValue>
TwoHalves(double stepDn, double flicker)
{
  CounterSeededRandom random(3);
  Stack<GreyValue>    stack{ Size, Size, Frames, {} };
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const double factor = 1.0 + flicker * random.Normal();
    for (std::size_t p = 0; p < Size * Size; ++p)
    {
      const auto   x = static_cast<double>(p % Size);
      const auto   y = static_cast<double>(p / Size);
      const bool   isRight = p % Size >= Size / 2;
      const double electrons = (isRight ? 400.0 : 200.0) * (1.0 + 0.6 * std::sin(0.1 * x) * std::sin(0.13 * y));
      const double offset = OffsetDn + (isRight ? 0.5 : -0.5) * stepDn;
      const auto   charge = static_cast<double>(random.Poisson(factor * electrons));
      stack.pixels.push_back(static_cast<GreyValue>(std::lround(offset + charge + 2.0 * random.Normal())));
    }
  }
  return stack;
}
} // namespace

TEST(SensorNoisePartOffsets, OneOffsetStaysIdentified)
{
  const Report report = Measure(TwoHalves(0.0, 0.03)).GetReport();
  ExpectHolds(report.offset, OffsetDn);
  EXPECT_LT(*report.offset.standardError, 2.0);
}

TEST(SensorNoisePartOffsets, UnlikeOffsetsThatMatterFail)
{
  const Report report = Measure(TwoHalves(12.0, 0.03)).GetReport();
  EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetNotIdentifiable));
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
}

TEST(SensorNoisePartOffsets, ErrorContainsSmallDifferences)
{
  const Report alike = Measure(TwoHalves(0.0, 0.05)).GetReport();
  const Report unlike = Measure(TwoHalves(5.0, 0.05)).GetReport();
  EXPECT_GT(*unlike.offset.standardError, 2.0 * *alike.offset.standardError);
  ExpectHolds(unlike.offset, OffsetDn);
}

// Between the levels of the halves, the line has a slope other than the gain.
TEST(SensorNoisePartOffsets, ErrorsOfTheLineContainDifferences)
{
  const Report alike = Measure(TwoHalves(0.0, 0.03)).GetReport();
  for (const double stepDn : { 20.0, -20.0 })
  {
    const Report unlike = Measure(TwoHalves(stepDn, 0.03)).GetReport();
    ExpectHolds(unlike.gain, 1.0);
    ExpectHolds(unlike.intercept, 4.0 - OffsetDn);
    EXPECT_GT(*unlike.gain.standardError, 2.0 * *alike.gain.standardError);
  }
  ExpectHolds(alike.gain, 1.0);
}
