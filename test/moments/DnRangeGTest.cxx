// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double NoisyDn2 = 400.0; // noise of 20 DN: above half a step of 1 and of 16

/** Extremes of the pixels of a stack over time. */
struct Extremes
{
  DnHistogram minima;
  DnHistogram maxima;

  void
  AddPixels(int count, int minimum, int maximum)
  {
    for (int i = 0; i < count; ++i)
    {
      minima.Add(minimum);
      maxima.Add(maximum);
    }
  }
  DnRange
  Find(const DnSettings & settings = {}, double varianceDn2 = NoisyDn2) const
  {
    return FindDnRange(minima, maxima, varianceDn2, settings);
  }
};

/** Returns two pixels at every digital number from \a lowest to \a highest in steps of \a step. The extremes of a pixel
 * are
 * \a spread digital numbers apart. */
Extremes
PixelsAtEveryNumber(int lowest, int highest, int step, int spread)
{
  Extremes extremes;
  for (int number = lowest; number + spread * step <= highest; number += step)
  {
    extremes.AddPixels(2, number, number + spread * step);
  }
  return extremes;
}

std::vector<std::int32_t>
NumbersScaledBy(double factor, int count)
{
  std::vector<std::int32_t> numbers;
  for (int number = 0; number < count; ++number)
  {
    numbers.push_back(static_cast<std::int32_t>(std::floor(number * factor + 0.5)));
  }
  return numbers;
}

void
ExpectMessageHolds(const Extremes & extremes, const DnSettings & settings, const std::vector<std::string> & words)
{
  try
  {
    extremes.Find(settings);
    FAIL() << "nothing was thrown";
  }
  catch (const std::invalid_argument & error)
  {
    for (const std::string & word : words)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}
} // namespace

TEST(SensorNoiseDnRange, StepIsTheMajorityOfTheSpacings)
{
  bool regular = false;
  EXPECT_EQ(FindQuantisationStep(NumbersScaledBy(1.0, 1000), regular), 1.0);
  EXPECT_TRUE(regular);
  EXPECT_EQ(FindQuantisationStep(NumbersScaledBy(16.0, 1000), regular), 16.0);
  EXPECT_TRUE(regular);
  auto gaps = NumbersScaledBy(16.0, 1000); // one digital number of ten is not attained: most distances are still 16
  for (std::size_t i = gaps.size() - 1; i > 0; --i)
  {
    if (i % 10 == 3)
    {
      gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  EXPECT_EQ(FindQuantisationStep(gaps, regular), 16.0);
  EXPECT_TRUE(regular);
}

TEST(SensorNoiseDnRange, RescaledDataAreIrregular)
{
  bool regular = true;
  // The 4,096 digital numbers have all 16 remainders: 1 in 16 is on any grid.
  EXPECT_EQ(FindQuantisationStep(NumbersScaledBy(65535.0 / 4095.0, 4096), regular), 16.0);
  EXPECT_FALSE(regular);
}

TEST(SensorNoiseDnRange, FewStrayNumbersDoNotMatter)
{
  bool regular = false;
  auto numbers = NumbersScaledBy(16.0, 1000);
  numbers.insert(numbers.begin() + 500, 499 * 16 + 5); // 1 of 1,001: under 2 %
  EXPECT_EQ(FindQuantisationStep(numbers, regular), 16.0);
  EXPECT_TRUE(regular);
}

TEST(SensorNoiseDnRange, TooFewNumbersHaveTheStepOne)
{
  bool regular = false;
  EXPECT_EQ(FindQuantisationStep({}, regular), 1.0);
  EXPECT_EQ(FindQuantisationStep({ 40 }, regular), 1.0);
  EXPECT_EQ(FindQuantisationStep({ 40, 43, 50 }, regular), 1.0);
  EXPECT_TRUE(regular);
}

TEST(SensorNoiseDnRange, BitDepthIsTheSmallestThatHoldsTheNumbers)
{
  const std::vector<std::pair<int, int>> highestAndBits{ { 255, 8 },    { 256, 10 },  { 1023, 10 },  { 1024, 12 },
                                                         { 4095, 12 },  { 4096, 14 }, { 16383, 14 }, { 16384, 16 },
                                                         { 65535, 16 }, { 200, 8 } };
  for (const auto & expected : highestAndBits)
  {
    const DnRange range = PixelsAtEveryNumber(expected.first - 150, expected.first, 1, 40).Find();
    EXPECT_EQ(range.bitDepth, expected.second) << expected.first;
    EXPECT_EQ(range.bitDepthSource, "data");
    EXPECT_EQ(range.quantisationStepDn, 1.0);
  }
  const DnRange aligned = PixelsAtEveryNumber(0, 4095 * 16, 16, 5).Find(); // 12 bits left-aligned in 16
  EXPECT_EQ(aligned.quantisationStepDn, 16.0);
  EXPECT_EQ(aligned.bitDepth, 12);
  EXPECT_EQ(aligned.clipHighDn, 4095.0 * 16.0);
}

TEST(SensorNoiseDnRange, WithoutClipLevelTheDnRangeClips)
{
  DnSettings settings;
  settings.bitDepth = 12;
  const DnRange range = PixelsAtEveryNumber(100, 3000, 1, 40).Find(settings);
  EXPECT_EQ(range.bitDepth, 12);
  EXPECT_EQ(range.bitDepthSource, "given");
  EXPECT_EQ(range.clipLowDn, 0.0);
  EXPECT_EQ(range.clipHighDn, 4095.0);
  EXPECT_EQ(range.clipSource, "code range");
}

TEST(SensorNoiseDnRange, DataBeyondTheBitDepthAreRefusedWithBothNumbers)
{
  DnSettings settings;
  settings.bitDepth = 10;
  ExpectMessageHolds(PixelsAtEveryNumber(100, 3000, 1, 40), settings, { "3000", "10 bits", "1023" });
  EXPECT_THROW(Extremes().Find(), std::invalid_argument); // no pixel
}

TEST(SensorNoiseDnRange, ClipLevelsAreFound)
{
  Extremes extremes = PixelsAtEveryNumber(100, 3400, 1, 40);
  extremes.AddPixels(200, 3350, 3400); // these pixels saturate at 3,400 of 4,095
  DnRange range = extremes.Find();
  EXPECT_EQ(range.clipHighDn, 3400.0);
  EXPECT_EQ(range.clipLowDn, 0.0);
  EXPECT_EQ(range.clipSource, "low: code range, high: pile-up");
  extremes.AddPixels(200, 100, 150); // these pixels are clipped at 100
  range = extremes.Find();
  EXPECT_EQ(range.clipLowDn, 100.0);
  EXPECT_EQ(range.clipHighDn, 3400.0);
  EXPECT_EQ(range.clipSource, "pile-up");
  EXPECT_TRUE(range.IsClipped(100.0, 150.0));
  EXPECT_TRUE(range.IsClipped(3350.0, 3400.0));
  EXPECT_FALSE(range.IsClipped(101.0, 3399.0));
}

TEST(SensorNoiseDnRange, ClipLevelNeedsEightPixelsAndThreeTimesItsNeighbours)
{
  for (const int pixels : { 5, 6, 50 }) // besides the 2 pixels of PixelsAtEveryNumber
  {
    Extremes extremes = PixelsAtEveryNumber(100, 3400, 1, 40);
    extremes.AddPixels(pixels, 3350, 3400);
    EXPECT_EQ(extremes.Find().clipHighDn, pixels >= 6 ? 3400.0 : 4095.0) << pixels;
    extremes.AddPixels(16, 3345, 3390); // 18 with the pixels of PixelsAtEveryNumber: 55 are needed at the end
    EXPECT_EQ(extremes.Find().clipHighDn, 4095.0) << pixels;
  }
}

TEST(SensorNoiseDnRange, ClipLevelOfLeftAlignedNumbersIsFound)
{
  Extremes extremes = PixelsAtEveryNumber(1600, 3400 * 16, 16, 40);
  extremes.AddPixels(200, 3350 * 16, 3400 * 16);
  EXPECT_EQ(extremes.Find().clipHighDn, 3400.0 * 16.0);
}

TEST(SensorNoiseDnRange, GivenValuesWin)
{
  Extremes extremes = PixelsAtEveryNumber(100, 3400, 1, 40);
  extremes.AddPixels(200, 3350, 3400);
  extremes.AddPixels(200, 100, 150);
  DnRange range = extremes.Find(MakeDnSettings(14, 50.0, 3300.0, 2.0));
  EXPECT_EQ(range.bitDepth, 14);
  EXPECT_EQ(range.clipLowDn, 50.0);
  EXPECT_EQ(range.clipHighDn, 3300.0);
  EXPECT_EQ(range.quantisationStepDn, 2.0);
  EXPECT_EQ(range.clipSource, "given");
  range = extremes.Find(MakeDnSettings(0, std::nan(""), 3300.0, 0.0));
  EXPECT_EQ(range.clipSource, "low: pile-up, high: given");
  EXPECT_EQ(range.clipLowDn, 100.0);
}

TEST(SensorNoiseDnRange, PlainNumbersThatAreToBeFoundAreNotSet)
{
  const double     nan = std::numeric_limits<double>::quiet_NaN();
  const DnSettings settings = MakeDnSettings(0, nan, nan, 0.0);
  EXPECT_FALSE(settings.bitDepth || settings.clipLowDn || settings.clipHighDn || settings.quantisationStepDn);
}

TEST(SensorNoiseDnRange, NoiseBelowHalfAStepUsesTheDnRangeOnly)
{
  Extremes extremes = PixelsAtEveryNumber(100, 3400, 1, 0);
  extremes.AddPixels(200, 3400, 3400);
  EXPECT_EQ(extremes.Find({}, 0.24).clipHighDn, 4095.0);
  EXPECT_EQ(extremes.Find({}, 0.25).clipHighDn, 3400.0); // (1/2)^2, the least variance for saturation levels
}

TEST(SensorNoiseDnRange, ConstantStackHasNoClipLevel)
{
  Extremes extremes;
  extremes.AddPixels(1000, 700, 700);
  const DnRange range = extremes.Find({}, 0.0);
  EXPECT_EQ(range.clipLowDn, 0.0);
  EXPECT_EQ(range.clipHighDn, 1023.0);
  EXPECT_EQ(range.clipSource, "code range");
  EXPECT_FALSE(range.IsClipped(700.0, 700.0));
}

TEST(SensorNoiseDnRange, SignedDataReachBelowZero)
{
  Extremes extremes = PixelsAtEveryNumber(-300, 900, 1, 40);
  DnRange  range = extremes.Find();
  EXPECT_FALSE(range.clipLowDn); // the lowest number of the type is no clip level of a sensor
  EXPECT_EQ(range.clipSource, "low: none, high: code range");
  EXPECT_EQ(range.bitDepth, 10);
  extremes.AddPixels(200, -300, -250);
  EXPECT_EQ(extremes.Find().clipLowDn, -300.0);
  extremes.AddPixels(1, -32768, 0); // the ends of the types fit the histogram
  extremes.AddPixels(1, 0, 65535);
  range = extremes.Find();
  EXPECT_EQ(range.clipHighDn, 65535.0);
  EXPECT_TRUE(range.IsClipped(0.0, 65535.0));
}

TEST(SensorNoiseDnRange, StuckPixelsDoNotHideASaturationLevel)
{
  Extremes extremes = PixelsAtEveryNumber(100, 3700, 1, 40);
  extremes.AddPixels(200, 3600, 3700);
  ASSERT_EQ(extremes.Find().clipHighDn, 3700.0);
  extremes.AddPixels(20, 4095, 4095); // a tenth of the pixels at the level
  EXPECT_EQ(extremes.Find().clipHighDn, 3700.0);
  EXPECT_TRUE(extremes.Find().IsClipped(4095.0, 4095.0));
  extremes.AddPixels(30, 4095, 4095); // a quarter: the sensor attains more
  EXPECT_EQ(extremes.Find().clipHighDn, 4095.0);
}

TEST(SensorNoiseDnRange, DeadPixelsDoNotHideAFloor)
{
  Extremes extremes = PixelsAtEveryNumber(64, 3000, 1, 40);
  extremes.AddPixels(200, 64, 100);
  extremes.AddPixels(3, 0, 0);
  EXPECT_EQ(extremes.Find().clipLowDn, 64.0);
}

TEST(SensorNoiseDnRange, FloatingPointDataHaveOnlyWhatIsGiven)
{
  DnRange range = GivenDnRange({});
  EXPECT_FALSE(range.bitDepth || range.clipLowDn || range.clipHighDn);
  EXPECT_EQ(range.quantisationStepDn, 0.0);
  EXPECT_EQ(range.clipSource, "none");
  EXPECT_FALSE(range.IsClipped(-1e300, 1e300));
  range = GivenDnRange(MakeDnSettings(12, 0.0, 4095.0, 1.0));
  EXPECT_EQ(range.bitDepth, 12);
  EXPECT_EQ(range.clipSource, "given");
  EXPECT_TRUE(range.IsClipped(10.0, 4095.0));
}

TEST(SensorNoiseDnRange, AStepBelowOneHasTheClipLevelsOfStepOne)
{
  Extremes extremes = PixelsAtEveryNumber(100, 3400, 1, 40);
  extremes.AddPixels(200, 3350, 3400);
  DnSettings settings;
  settings.quantisationStepDn = 0.5;
  settings.bitDepth = 14;
  EXPECT_EQ(extremes.Find(settings).clipHighDn, 3400.0);
}
