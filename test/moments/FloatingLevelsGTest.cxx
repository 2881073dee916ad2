// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/StackMaps.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>

using namespace sensornoise;

namespace
{
constexpr double NoisyDn2 = 400.0;

/** Extremes of the pixels of a stack over time, as digital numbers and as digital numbers times \a scale. */
struct Extremes
{
  double          scale{ 1.0 };
  DnHistogram     histogramOfMinima{};
  DnHistogram     histogramOfMaxima{};
  OutermostLevels minima{ OutermostLevels::End::Low };
  OutermostLevels maxima{ OutermostLevels::End::High };

  void
  AddPixels(int count, int minimum, int maximum)
  {
    for (int i = 0; i < count; ++i)
    {
      histogramOfMinima.Add(minimum);
      histogramOfMaxima.Add(maximum);
      minima.Add(scale * minimum);
      maxima.Add(scale * maximum);
    }
  }
  /** Adds two pixels at every digital number. */
  void
  AddRamp(int lowest, int highest, int step = 1)
  {
    for (int number = lowest; number + 40 * step <= highest; number += step)
    {
      this->AddPixels(2, number, number + 40 * step);
    }
  }
  DnRange
  Find(const DnSettings & settings = {}, double varianceDn2 = NoisyDn2, const ExtremeDepths & depths = {}) const
  {
    return FindLevels(minima, maxima, scale * scale * varianceDn2, settings, depths);
  }
  /** Expects the clip levels of the grey values, found from repeated extreme values, times the scale, and no others. */
  void
  ExpectLevelsOfIntegers(double varianceDn2 = NoisyDn2) const
  {
    const DnRange dnRange =
      FindDnRange(histogramOfMinima, histogramOfMaxima, varianceDn2, MakeDnSettings(16, NAN, NAN, 0.0));
    const DnRange levels = this->Find({}, varianceDn2);
    const bool    isLow = dnRange.clipSource == "pile-up" || dnRange.clipSource == "low: pile-up, high: code range";
    const bool    isHigh = dnRange.clipSource == "pile-up" || dnRange.clipSource == "low: code range, high: pile-up";
    EXPECT_EQ(levels.clipLowDn, isLow ? std::optional<double>(scale * *dnRange.clipLowDn) : std::nullopt);
    EXPECT_EQ(levels.clipHighDn, isHigh ? std::optional<double>(scale * *dnRange.clipHighDn) : std::nullopt);
  }
};
} // namespace

TEST(SensorNoiseFloatingLevels, ClipLevelsAreFoundAndTheOtherEndStaysOpen)
{
  Extremes extremes;
  extremes.AddRamp(100, 3400);
  EXPECT_EQ(extremes.Find().clipSource, "none");
  EXPECT_FALSE(extremes.Find().clipLowDn || extremes.Find().clipHighDn);
  extremes.AddPixels(200, 3350, 3400);
  DnRange range = extremes.Find();
  EXPECT_EQ(range.clipHighDn, 3400.0);
  EXPECT_FALSE(range.clipLowDn);
  EXPECT_EQ(range.clipSource, "low: none, high: pile-up");
  EXPECT_TRUE(range.IsClipped(-1e300, 3400.0));
  EXPECT_FALSE(range.IsClipped(-1e300, std::nextafter(3400.0, 0.0)));
  extremes.AddPixels(200, 100, 150);
  range = extremes.Find();
  EXPECT_EQ(range.clipLowDn, 100.0);
  EXPECT_EQ(range.clipSource, "pile-up");
  EXPECT_FALSE(range.bitDepth);
  EXPECT_EQ(range.quantisationStepDn, 0.0); // floating-point levels are not quantized
}

TEST(SensorNoiseFloatingLevels, AreFoundWhereTheIntegersAre)
{
  for (const double scale : { 1.0, 1.0 / 65535.0, 7.3e4 })
  {
    for (const int step : { 1, 16 })
    {
      for (const int pixels : { 0, 5, 6, 50, 52, 53, 200 })
      {
        Extremes extremes;
        extremes.scale = scale;
        extremes.AddRamp(100 * step, 3400 * step, step);
        extremes.AddPixels(pixels, 3350 * step, 3400 * step);
        extremes.ExpectLevelsOfIntegers();
        extremes.AddPixels(pixels / 2, 100 * step, 150 * step);
        extremes.ExpectLevelsOfIntegers();
        extremes.AddPixels(16, 3345 * step, 3390 * step); // 18 at one inner level: 55 are needed at the end
        extremes.ExpectLevelsOfIntegers();
        extremes.AddPixels(5000, 1000 * step, 3300 * step); // too far from the end
        extremes.ExpectLevelsOfIntegers();
      }
    }
  }
}

TEST(SensorNoiseFloatingLevels, CoarseQuantizationAndRareNoiseHaveNoClipLevel)
{
  Extremes extremes;
  extremes.AddRamp(100, 3400);
  extremes.AddPixels(200, 3400, 3400);
  EXPECT_FALSE(extremes.Find({}, 0.24).clipHighDn);
  EXPECT_EQ(extremes.Find({}, 0.25).clipHighDn, 3400.0); // (1/2)^2, the least variance for saturation levels
  EXPECT_FALSE(extremes.Find({}, NoisyDn2, { 0.0, 2.5 }).clipHighDn);
  EXPECT_EQ(extremes.Find({}, NoisyDn2, { 2.5, 2.4 }).clipHighDn, 3400.0);
  Extremes constant;
  constant.AddPixels(1000, 700, 700);
  EXPECT_EQ(constant.Find({}, 0.0).clipSource, "none");
  EXPECT_EQ(Extremes().Find().clipSource, "none"); // no finite pixel
}

TEST(SensorNoiseFloatingLevels, GivenValuesWin)
{
  Extremes extremes;
  extremes.AddRamp(100, 3400);
  extremes.AddPixels(200, 3350, 3400);
  extremes.AddPixels(200, 100, 150);
  DnRange range = extremes.Find(MakeDnSettings(14, 50.0, 3300.0, 2.0));
  EXPECT_EQ(range.bitDepth, 14);
  EXPECT_EQ(range.clipLowDn, 50.0);
  EXPECT_EQ(range.clipHighDn, 3300.0);
  EXPECT_EQ(range.quantisationStepDn, 2.0);
  EXPECT_EQ(range.clipSource, "given");
  range = extremes.Find(MakeDnSettings(0, NAN, 3300.0, 0.0));
  EXPECT_EQ(range.clipLowDn, 100.0);
  EXPECT_EQ(range.clipHighDn, 3300.0);
  EXPECT_EQ(range.clipSource, "low: pile-up, high: given");
  EXPECT_FALSE(extremes.Find(MakeDnSettings(0, NAN, NAN, 41.0)).clipHighDn); // noise of 20 DN, below half a step
}
