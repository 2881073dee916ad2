// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sensornoise;

TEST(SensorNoiseText, GivenNumbersHaveSixDigits)
{
  EXPECT_EQ(Text(100.0), "100");
  EXPECT_EQ(Text(0.123456789), "0.123457");
}

TEST(SensorNoiseText, FoundNumbersHaveThreeDigitsOrAllThatAreWhole)
{
  EXPECT_EQ(Rounded(0.0123456), "0.0123");
  EXPECT_EQ(Rounded(-98.765), "-98.8");
  EXPECT_EQ(Rounded(999.6), "1000");
  EXPECT_EQ(Rounded(1000.4), "1000");
  EXPECT_EQ(Rounded(65534.7), "65535");
  EXPECT_EQ(Rounded(0.0), "0");
  EXPECT_EQ(Rounded(HUGE_VAL), "inf");
  EXPECT_EQ(Percent(0.0442924), "4.43 %");
  EXPECT_EQ(Percent(1.0), "100 %");
}

TEST(SensorNoiseText, NumbersBesideABoundReadDifferently)
{
  EXPECT_EQ(PercentApart(0.12003, 0.12), "12.003 %");
  EXPECT_EQ(PercentApart(0.119996, 0.12), "11.9996 %");
  EXPECT_EQ(PercentApart(0.131, 0.12), "13.1 %");
  EXPECT_EQ(RoundedApart(1000.4, 1000.0), "1000.4");
  EXPECT_EQ(RoundedApart(0.12, 0.12), "0.12");
  EXPECT_EQ(RoundedApart(std::nan(""), 0.12), "nan");
}

TEST(SensorNoiseText, MeasuredNumbersEndWhereTheirErrorDoes)
{
  EXPECT_EQ(Measured(0.165967, 0.00377362), "0.1660 +- 0.0038");
  EXPECT_EQ(Measured(-774.91, 0.77), "-774.91 +- 0.77");
  EXPECT_EQ(Measured(12345.0, 678.0), "12350 +- 680");
  EXPECT_EQ(Measured(1.0, 0.0996), "1.00 +- 0.10");
  EXPECT_EQ(Measured(2.0, 1e-308), "2 +- 1e-308"); // has too few digits to be rounded
  EXPECT_EQ(Measured(1.0, 0.1), "1.00 +- 0.10");
  EXPECT_EQ(Measured(99.96, 1.0), "100.0 +- 1.0");
  EXPECT_EQ(Measured(3.0, 0.0), "3 +- 0");
  EXPECT_EQ(Measured(3.0, std::nan("")), "3 +- nan");
}
