// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Numbers as text: the shortest that reads back, and a given number of decimals or digits; text as numbers.
#include "base/Text.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <optional>

using sensornoise::FiniteNumber;
using sensornoise::FixedText;
using sensornoise::GeneralText;
using sensornoise::ShortestText;

TEST(NumberText, IsReadAsTheSameNumber)
{
  using Limits = std::numeric_limits<double>;
  for (const double number :
       { 0.0, 0.1, 1.0 / 3.0, -2.5e-308, std::nextafter(1.0, 2.0), Limits::max(), Limits::denorm_min() })
  {
    EXPECT_EQ(std::strtod(ShortestText(number).c_str(), nullptr), number);
    EXPECT_EQ(std::strtod(GeneralText(number, 17).c_str(), nullptr), number);
  }
}

TEST(NumberText, IsNoLongerThanItHasToBe)
{
  EXPECT_EQ(ShortestText(0.1), "0.1");
  EXPECT_EQ(ShortestText(-2.0), "-2");
  EXPECT_EQ(ShortestText(1e-7), "1e-07");
}

TEST(NumberText, HasTheDigitsThatWereAsked)
{
  EXPECT_EQ(FixedText(2.0 / 3.0, 3), "0.667");
  EXPECT_EQ(FixedText(-0.25, 0), "-0");
  EXPECT_EQ(FixedText(1e22, 1), "10000000000000000000000.0");
  EXPECT_EQ(FixedText(1.0, 99), "1.00000000000000000000"); // 20 at most
  EXPECT_EQ(GeneralText(1234567.0, 3), "1.23e+06");
  EXPECT_EQ(GeneralText(0.25, 3), "0.25");
}

TEST(NumberText, IsReadWithAPointToItsEnd)
{
  EXPECT_EQ(FiniteNumber("1.5"), 1.5);
  EXPECT_EQ(FiniteNumber(" +2e3"), 2000.0);
  EXPECT_EQ(FiniteNumber("1e-400"), 0.0);
  for (const char * const other : { "", " ", "1,5", "1.5 ", "1e", "0x10", "1e400", "inf", "nan" })
  {
    EXPECT_EQ(FiniteNumber(other), std::nullopt) << other;
  }
}
