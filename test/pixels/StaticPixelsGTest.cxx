// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"
#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/Simd.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/RoughnessClasses.h"
#include "helpers/ProjectionTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::projection;

namespace
{
/** Noise with the variance 400 DN^2, multiplied by a factor at some pixels. */
struct Noise
{
  Input             input;
  ProjectedSquares  squares;
  ProjectedVariance projected;
  RejectionModel    line;

  explicit Noise(const std::function<double(std::size_t p)> & factor)
    : input(Series(factor))
    , squares(input.Project())
    , projected(squares, 0.0)
  {
    line.line.intercept = 400.0;
    line.line.isDetermined = true;
  }
  static Eigen::MatrixXd
  Series(const std::function<double(std::size_t p)> & factor)
  {
    Eigen::MatrixXd series = NormalSeries();
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      series.col(static_cast<Eigen::Index>(p)) *= std::sqrt(factor(p));
    }
    return series;
  }
  ClassFit
  Test() const
  {
    return TestClasses(projected, line, input.mask, SerialFor);
  }
  std::vector<std::uint8_t>
  Rejected() const
  {
    return RejectNeighbourhoods(projected, line, input.mask, SerialFor);
  }
};

/** Returns whether the variance ratio of a pixel is far above 1. */
bool
IsFarAbove(double ratio, double dof)
{
  return !(ratio < FarLimits(dof).high);
}
bool
IsFarOff(double ratio, double dof)
{
  return IsFarAbove(ratio, dof) || !(ratio > FarLimits(dof).low);
}

double
Everywhere(std::size_t)
{
  return 1.0;
}

/** Returns whether a pixel is among the 14 x 14 pixels in the middle, less a margin. */
bool
IsInArea(std::size_t p, std::size_t margin = 0)
{
  const std::size_t x = p % Width;
  const std::size_t y = p / Width;
  return x >= 30 + margin && x < 44 - margin && y >= 25 + margin && y < 39 - margin;
}
} // namespace

TEST(SensorNoiseStaticPixels, NoiseFitsInAllClassesAndPlaces)
{
  const Noise noise(Everywhere);
  const auto  fit = noise.Test();
  EXPECT_EQ(fit.firstBad, ProjectedVariance::Classes);
  ASSERT_EQ(fit.ratio.size(), ProjectedVariance::Classes);
  EXPECT_NEAR(fit.reducedChi2, 1.0, 1.5); // 23 degrees of freedom: 5 standard deviations of sqrt(2 / 23)
  for (std::size_t c = 0; c < 15; ++c)
  {
    EXPECT_NEAR(fit.ratio[c], 1.0, 0.08) << c; // 5 sqrt(2 / 26 / 280 pixels)
  }
  const auto rejected = noise.Rejected();
  EXPECT_EQ(std::count(rejected.begin(), rejected.end(), std::uint8_t{ 1 }), 0);
}

TEST(SensorNoiseStaticPixels, RoughPixelsOfTooLargeAVarianceAreLeftOut)
{
  const Noise plain(Everywhere);
  const Noise noise([&](std::size_t p) { return plain.projected.ClassOf(p) >= 16 ? 1.8 : 1.0; });
  const auto  fit = noise.Test();
  // The class of a pixel hardly depends on its noise: some pixels near the bounds of class 16 change their class.
  EXPECT_GE(fit.firstBad, 15u);
  EXPECT_LE(fit.firstBad, 17u);
  EXPECT_GT(fit.ratio[20], 1.4);
}

TEST(SensorNoiseStaticPixels, FailingClassesAreKeptWhereTheGainNeedsThem)
{
  // The classes below 16 determine a slope to about 0.008 DN: a gain of 0.02 to 40 %, of 0.001 not at all. The rough
  // classes deviate by 80 %.
  const Noise plain(Everywhere);
  Noise       noise([&](std::size_t p) { return plain.projected.ClassOf(p) >= 16 ? 1.8 : 1.0; });
  noise.line.line.gain = 0.02;
  EXPECT_LE(noise.Test().firstBad, 17u);
  EXPECT_EQ(noise.Test().keptDeviation, 0.0);
  noise.line.line.gain = 0.001;
  EXPECT_EQ(noise.Test().firstBad, ProjectedVariance::Classes);
  EXPECT_NEAR(noise.Test().keptDeviation, 0.8, 0.3); // the largest of 8 classes of 40 to 100 pixels, each to 5 %
}

// Motion adds variance, and takes none: pixels that are far below the model do not move, so that the model is wrong.
TEST(SensorNoiseStaticPixels, ClassesBelowTheModelAreKept)
{
  const Noise plain(Everywhere);
  const Noise quiet([&](std::size_t p) { return plain.projected.ClassOf(p) >= 16 ? 0.1 : 1.0; });
  EXPECT_EQ(quiet.Test().firstBad, ProjectedVariance::Classes);
  EXPECT_TRUE(quiet.Test().isBelowModel);
  EXPECT_FALSE(plain.Test().isBelowModel);
  const Noise loud([&](std::size_t p) { return plain.projected.ClassOf(p) >= 16 ? 1.8 : 1.0; });
  EXPECT_FALSE(loud.Test().isBelowModel);
}

TEST(SensorNoiseStaticPixels, RatiosOfLevelsFollowTheVarianceOfEachLevel)
{
  const std::vector<double> mean = WavyScene(Width, Height);
  const auto [low, high] = std::minmax_element(mean.begin(), mean.end());
  const double range = *high - *low;
  Noise        noise([&, low = *low](std::size_t p) { return 0.4 + 0.6 * (mean[p] - low) / range; });
  SetRatiosOfLevels(noise.line, noise.projected, noise.input.mask);
  ASSERT_GE(noise.line.levels.size(), 4u);
  for (std::size_t k = 0; k < noise.line.levels.size(); ++k)
  {
    const double expected = 0.4 + 0.6 * (noise.line.levels[k] - *low) / range;
    EXPECT_NEAR(noise.line.ratios[k], expected, 0.2 * expected) << k; // 5 sqrt(2 / 26 / 50 pixels)
  }
  EXPECT_EQ(noise.Test().firstBad, ProjectedVariance::Classes);
}

TEST(SensorNoiseStaticPixels, ErrorOfTheModelIsAnErrorOfItsClasses)
{
  const Noise plain(Everywhere);
  Noise       noise([&](std::size_t p) { return plain.projected.ClassOf(p) >= 16 ? 1.3 : 1.0; }); // no outliers
  EXPECT_LE(noise.Test().firstBad, 17u);
  noise.line.line.covariance(0, 0) = 1e4; // a slope that is not known
  EXPECT_EQ(noise.Test().firstBad, ProjectedVariance::Classes);
  EXPECT_EQ(noise.Test().keptDeviation, 0.0);
}

TEST(SensorNoiseStaticPixels, AreaOfTooLargeAVarianceIsFound)
{
  const auto rejected = Noise([](std::size_t p) { return IsInArea(p) ? 2.5 : 1.0; }).Rejected();
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    if (IsInArea(p))
    {
      EXPECT_EQ(rejected[p], 1) << p % Width << ' ' << p / Width;
    }
    const bool isFar = p % Width < 10 || p % Width >= 64 || p / Width < 5 || p / Width >= 59;
    EXPECT_FALSE(isFar && rejected[p] != 0) << p % Width << ' ' << p / Width;
  }
}

TEST(SensorNoiseStaticPixels, AreaOfMovingThingsIsFound)
{
  const auto rejected = Noise([](std::size_t p) { return IsInArea(p) ? 100.0 : 1.0; }).Rejected();
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    EXPECT_FALSE(IsInArea(p) && rejected[p] == 0) << p % Width << ' ' << p / Width;
  }
}

TEST(SensorNoiseStaticPixels, SingleNoisyPixelsAreNotTheirSurroundings)
{
  const auto rejected = Noise([](std::size_t p) { return p % 97 == 0 ? 100.0 : 1.0; }).Rejected();
  EXPECT_EQ(std::count(rejected.begin(), rejected.end(), std::uint8_t{ 1 }), 0);
}

TEST(SensorNoiseStaticPixels, FarOffIsFiveStandardDeviations)
{
  for (const double dof : { 10.0, 30.0, 100.0 })
  {
    // Tail probabilities of the normal distribution. The error of the cube root is about 0.1 standard deviations.
    const auto above = [&](double z) { return ChiSquareUpperQuantile(0.5 * std::erfc(z / std::sqrt(2.0)), dof) / dof; };
    const auto below = [&](double z) { return ChiSquareQuantile(0.5 * std::erfc(z / std::sqrt(2.0)), dof) / dof; };
    EXPECT_TRUE(IsFarAbove(above(5.2), dof) && IsFarOff(above(5.2), dof)) << dof;
    EXPECT_FALSE(IsFarAbove(above(4.8), dof) || IsFarOff(above(4.8), dof)) << dof;
    EXPECT_FALSE(IsFarAbove(below(6.5), dof)) << dof;
    EXPECT_FALSE(IsFarOff(below(4.3), dof)) << dof;
    EXPECT_TRUE(IsFarOff(below(6.0), dof)) << dof;
  }
}

TEST(SensorNoiseStaticPixels, RunsAreTestedAsSinglePixelsAre)
{
  Noise noise([](std::size_t p) { return p % 97 == 0 ? 3.0 : p % 89 == 0 ? 0.1 : 1.0; });
  noise.line.line.gain = 0.1;
  noise.line.line.noiseDispersionDn4 = 900.0;
  const ReferenceFrame & frame = noise.projected.GetFrame();
  const auto [darkest, brightest] = std::minmax_element(frame.mean.begin(), frame.mean.end());
  for (const bool deviates : { false, true })
  {
    if (deviates)
    {
      const double range = *brightest - *darkest;
      noise.line.levels = { *darkest + 0.2 * range, *darkest + 0.3 * range, *darkest + 0.7 * range };
      noise.line.ratios = { 0.9, 1.2, 1.05 };
    }
    noise.line.byNeighbours = deviates;
    TestedRun   run;
    std::size_t far = 0;
    ForRuns(Width, 20 * Width, [&](std::size_t first, std::size_t pixels) {
      ASSERT_LE(pixels, PixelsPerRun);
      run.Test(noise.projected, noise.line, first, pixels);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        const std::size_t p = first + i;
        if (noise.input.mask[p] != 0)
        {
          const double expected = noise.line.At(noise.line.LevelOf(frame, p));
          const double ratio = noise.projected.GetVariance()[p] / expected;
          const double dof = noise.line.EffectiveDof(noise.projected.GetDof()[p], expected);
          ASSERT_NEAR(run.expected[i], expected, 1e-12 * expected) << p;
          ASSERT_NEAR(run.ratio[i], ratio, 1e-12 * ratio) << p;
          ASSERT_EQ(run.isAbove[i] != 0.0, IsFarAbove(ratio, dof)) << p;
          ASSERT_EQ(run.isOff[i] != 0.0, IsFarOff(ratio, dof)) << p;
          far += IsFarOff(ratio, dof) ? 1 : 0;
        }
      }
    });
    EXPECT_GT(far, 0U);
  }
}
