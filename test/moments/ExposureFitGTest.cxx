// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"
#include "moments/Exposures.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double OffsetDn = 100.0;
constexpr double FullDn = 3500.0;

DnRange
DnRangeOf12Bits()
{
  DnRange dnRange;
  dnRange.clipHighDn = 4095.0;
  dnRange.clipSource = "code range";
  return dnRange;
}

/** Returns the signal of a quadratic response, as ResponseShape::Quadratic [DN]. */
double
Signal(double exposure, double nonlinearity)
{
  return FullDn * (exposure + nonlinearity * (exposure - exposure * exposure));
}

ExposureLevel
ExactLevel(double exposure, double nonlinearity, std::size_t frames = 2)
{
  return { exposure, frames, OffsetDn + Signal(exposure, nonlinearity), 0.0, 0.0, 0.0 };
}

/** Returns exposures from 0.1 to 1. */
std::vector<double>
Exposures(std::size_t levels)
{
  std::vector<double> exposures;
  for (std::size_t i = 0; i < levels; ++i)
  {
    exposures.push_back(0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(levels - 1));
  }
  return exposures;
}

std::vector<ExposureLevel>
ExactLevels(std::size_t levels, double nonlinearity, bool hasDark)
{
  std::vector<ExposureLevel> all;
  if (hasDark)
  {
    all.push_back(ExactLevel(0.0, nonlinearity));
  }
  for (const double exposure : Exposures(levels))
  {
    all.push_back(ExactLevel(exposure, nonlinearity));
  }
  return all;
}

/** Returns the linearity error of EMVA 1288 for a response without noise [1], from the normal equations of the line. */
double
TrueError(std::size_t levels, double nonlinearity, bool hasDark)
{
  double       sums[5] = {};
  const auto   exposures = Exposures(levels);
  const double dark = hasDark ? 1.0 : 0.0;
  for (const double e : exposures)
  {
    const double y = Signal(e, nonlinearity);
    const double weight = 1.0 / (hasDark ? y * y : e * e);
    sums[0] += weight;
    sums[1] += weight * e;
    sums[2] += weight * e * e;
    sums[3] += weight * y;
    sums[4] += weight * e * y;
  }
  const double determinant = sums[0] * sums[2] - sums[1] * sums[1];
  const double intercept = (sums[2] * sums[3] - sums[1] * sums[4]) / determinant;
  const double slope = (sums[0] * sums[4] - sums[1] * sums[3]) / determinant;
  double       sum = 0.0;
  for (const double e : exposures)
  {
    sum += std::abs(Signal(e, nonlinearity) - intercept - slope * e) / (dark * intercept + slope * e);
  }
  return sum / static_cast<double>(levels);
}

double
ErrorOf(const ExposureFit & fit)
{
  EXPECT_TRUE(fit.squaredError) << fit.reason;
  return fit.squaredError ? std::sqrt(std::max(0.0, fit.squaredError->value)) : -1.0;
}
} // namespace

TEST(SensorNoiseExposureFit, AnExactLineHasNoErrorAndItsOwnOffset)
{
  for (const bool hasDark : { false, true })
  {
    const ExposureFit fit = FitExposures(ExactLevels(5, 0.0, hasDark), DnRangeOf12Bits());
    EXPECT_NEAR(ErrorOf(fit), 0.0, 1e-9);
    ASSERT_TRUE(fit.offsetDn && fit.responsivity);
    EXPECT_NEAR(fit.offsetDn->value, OffsetDn, 1e-8);
    EXPECT_NEAR(fit.responsivity->value, FullDn, 1e-8);
    EXPECT_EQ(fit.isOffsetOfDarkFrames, hasDark);
  }
}

TEST(SensorNoiseExposureFit, AnExactParabolaHasTheErrorOfTheDefinition)
{
  for (const bool hasDark : { false, true })
  {
    for (const double nonlinearity : { 0.01, 0.04, -0.03 })
    {
      const ExposureFit fit = FitExposures(ExactLevels(8, nonlinearity, hasDark), DnRangeOf12Bits());
      EXPECT_NEAR(ErrorOf(fit), TrueError(8, nonlinearity, hasDark), 1e-9);
      ASSERT_TRUE(fit.offsetDn);
      // The line deviates from the offset at exposure 0. The parabola does not, and their distance is the error.
      EXPECT_NEAR(fit.offsetDn->value, OffsetDn, hasDark ? 1e-8 : 1.0001 * fit.offsetDn->standardError);
    }
  }
}

TEST(SensorNoiseExposureFit, TheUnitOfTheExposuresChangesOnlyTheResponsivity)
{
  std::vector<ExposureLevel> levels = ExactLevels(6, 0.03, false);
  const ExposureFit          seconds = FitExposures(levels, DnRangeOf12Bits());
  for (ExposureLevel & level : levels)
  {
    level.exposure *= 1e6;
  }
  const ExposureFit microseconds = FitExposures(levels, DnRangeOf12Bits());
  EXPECT_NEAR(ErrorOf(microseconds), ErrorOf(seconds), 1e-12);
  EXPECT_NEAR(microseconds.offsetDn->value, seconds.offsetDn->value, 1e-8);
  EXPECT_NEAR(microseconds.responsivity->value * 1e6, seconds.responsivity->value, 1e-8);
}

TEST(SensorNoiseExposureFit, TheRangeIsFrom5To95PercentOfSaturation)
{
  std::vector<ExposureLevel> levels = ExactLevels(5, 0.0, true);
  levels.insert(levels.begin() + 1, ExactLevel(0.05, 0.0)); // 175 of 3995 DN: below 5 %
  levels.push_back({ 1.1, 2, OffsetDn + 0.96 * 3995.0, 0.0, 0.0, 0.0 });
  const ExposureFit fit = FitExposures(levels, DnRangeOf12Bits());
  ASSERT_EQ(fit.levels.size(), 8u);
  for (std::size_t i = 0; i < fit.levels.size(); ++i)
  {
    EXPECT_EQ(fit.levels[i].deviation.has_value(), i >= 2 && i <= 6) << i;
  }
  EXPECT_EQ(fit.saturationDn, 4095.0);
  EXPECT_EQ(fit.saturationSource, "code range");
  EXPECT_NEAR(ErrorOf(fit), 0.0, 1e-9);
}

TEST(SensorNoiseExposureFit, WithoutClipLevelTheLargestLevelIsInTheRange)
{
  const ExposureFit fit = FitExposures(ExactLevels(5, 0.0, false), DnRange());
  EXPECT_EQ(fit.saturationSource, "largest level");
  EXPECT_EQ(fit.saturationDn, OffsetDn + FullDn);
  for (const ExposureFit::Level & level : fit.levels)
  {
    EXPECT_TRUE(level.deviation) << level.exposure;
  }
}

TEST(SensorNoiseExposureFit, TheSourceIsThatOfTheHighClipLevel)
{
  DnRange dnRange = DnRangeOf12Bits();
  dnRange.SetClipSources("code range", "pile-up");
  EXPECT_EQ(FitExposures(ExactLevels(5, 0.0, false), dnRange).saturationSource, "pile-up");
}

TEST(SensorNoiseExposureFit, TooFewLevelsInTheRangeAreSaidToBe)
{
  std::vector<ExposureLevel> levels = ExactLevels(5, 0.0, true);
  levels.resize(3);
  const ExposureFit fit = FitExposures(levels, DnRangeOf12Bits());
  EXPECT_FALSE(fit.squaredError);
  EXPECT_EQ(fit.reason.find("only 2 of 3 exposures"), 0u) << fit.reason;
  ASSERT_TRUE(fit.offsetDn); // from the dark frames
  EXPECT_EQ(fit.offsetDn->value, OffsetDn);
}

TEST(SensorNoiseExposureFit, LevelsThatFallWithTheExposureAreRefused)
{
  std::vector<ExposureLevel> levels = ExactLevels(5, 0.0, false);
  std::swap(levels[0].meanDn, levels[4].meanDn);
  std::swap(levels[1].meanDn, levels[3].meanDn);
  const ExposureFit fit = FitExposures(levels, DnRangeOf12Bits());
  EXPECT_FALSE(fit.squaredError);
  EXPECT_NE(fit.reason.find("do not rise with the exposures"), std::string::npos) << fit.reason;
}

TEST(SensorNoiseExposureFit, SingleFramesTakeTheirScatterFromAParabola)
{
  std::vector<ExposureLevel> levels;
  for (const double exposure : Exposures(8))
  {
    levels.push_back(ExactLevel(exposure, 0.04, 1));
  }
  const ExposureFit fit = FitExposures(levels, DnRangeOf12Bits());
  EXPECT_EQ(fit.dof, 5.0);
  EXPECT_NEAR(ErrorOf(fit), TrueError(8, 0.04, false), 1e-9);
  levels.resize(3);
  const ExposureFit ofThree = FitExposures(levels, DnRangeOf12Bits());
  EXPECT_FALSE(ofThree.squaredError);
  EXPECT_EQ(ofThree.reason.find("no exposure has two frames"), 0u) << ofThree.reason;
}

namespace
{
/** Returns levels of frames whose illumination has the standard deviation \a flicker [1], with the shot noise of 1500
 * pixels of 0.35 DN/e-. */
std::vector<ExposureLevel>
NoisyLevels(std::size_t levels, std::size_t frames, double nonlinearity, double flicker, CounterSeededRandom & random)
{
  std::vector<ExposureLevel> all;
  for (const double exposure : Exposures(levels))
  {
    const double        noiseDn2 = 0.35 * Signal(exposure, nonlinearity) / 1500.0;
    ExposureLevel       level{ exposure, frames, 0.0, 0.0, noiseDn2, 0.0 };
    std::vector<double> own;
    for (std::size_t k = 0; k < frames; ++k)
    {
      own.push_back(OffsetDn + Signal(exposure * (1.0 + flicker * random.Normal()), nonlinearity) +
                    std::sqrt(noiseDn2) * random.Normal());
      level.meanDn += own.back() / static_cast<double>(frames);
    }
    for (const double value : own)
    {
      level.squaresDn2 += (value - level.meanDn) * (value - level.meanDn);
    }
    all.push_back(level);
  }
  return all;
}

/** Returns whether the 95 % interval of the squared error contains the square of the truth. */
bool
Holds(const ExposureFit & fit, double truth)
{
  const double reach = StudentQuantile(0.975, fit.dof) * fit.squaredError->standardError;
  const double low = fit.squaredError->value - reach;
  const double high = std::max(0.0, fit.squaredError->value) + reach;
  return (low <= 0.0 || low <= truth * truth) && truth * truth <= high;
}
} // namespace

// 400 bursts per case: 95 % of the intervals contain the truth, with a standard deviation of 1.1 %. The tolerance is
// four of these, plus 1.5 % for the first-order approximation of the errors.
TEST(SensorNoiseExposureFit, IntervalsHoldTheTruthAndNoiseIsNoError)
{
  struct Case
  {
    std::size_t levels;
    std::size_t frames;
    double      nonlinearity;
  };
  constexpr int       bursts = 400;
  CounterSeededRandom random(3);
  for (const Case & each : { Case{ 5, 2, 0.0 },
                             Case{ 5, 2, 0.01 },
                             Case{ 5, 2, 0.04 },
                             Case{ 12, 10, 0.0 },
                             Case{ 12, 10, 0.01 },
                             Case{ 12, 10, 0.04 },
                             Case{ 12, 1, 0.04 } })
  {
    const double truth = TrueError(each.levels, each.nonlinearity, false);
    int          held = 0;
    int          offsetsHeld = 0;
    double       mean = 0.0;
    double       largestError = 0.0;
    for (int i = 0; i < bursts; ++i)
    {
      const ExposureFit fit =
        FitExposures(NoisyLevels(each.levels, each.frames, each.nonlinearity, 0.003, random), DnRangeOf12Bits());
      ASSERT_TRUE(fit.squaredError);
      held += Holds(fit, truth) ? 1 : 0;
      mean += fit.squaredError->value / bursts;
      largestError = std::max(largestError, fit.squaredError->standardError);
      offsetsHeld +=
        std::abs(fit.offsetDn->value - OffsetDn) <= StudentQuantile(0.975, fit.dof) * fit.offsetDn->standardError ? 1
                                                                                                                  : 0;
    }
    const double least = 0.95 - 4.0 * std::sqrt(0.95 * 0.05 / bursts) - 0.015;
    EXPECT_GE(held, least * bursts) << each.levels << ' ' << each.frames << ' ' << each.nonlinearity;
    EXPECT_GE(offsetsHeld, least * bursts) << each.levels << ' ' << each.frames << ' ' << each.nonlinearity;
    if (each.nonlinearity == 0.0)
    {
      // Without the correction the mean is the variance of a level, (0.3 %)^2 / frames, times 3/5 or 10/12.
      const double noise = 0.003 * 0.003 / static_cast<double>(each.frames);
      EXPECT_NEAR(mean, 0.0, 0.15 * noise);
    }
  }
}
