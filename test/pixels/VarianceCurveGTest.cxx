// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceFit.h"
#include "pixels/VarianceLine.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double PivotDn = 500.0;
constexpr double Weight = 4.0; // weight of a bin [1/DN^4]

VarianceLine
MakeLine()
{
  VarianceLine line;
  line.gain = 0.5;
  line.intercept = 20.0;
  line.pivotDn = PivotDn;
  return line;
}

/** Returns a bin at a level above the pivot, with the mean excess \a excessAt of this level. */
template <typename TFunction>
CurveBin
BinAt(double x, TFunction excessAt, double weight = Weight)
{
  return { 100.0, weight, weight * x, weight * excessAt(x) };
}

/** Returns 64 bins of equal weight, at levels 2 DN apart and symmetric about the pivot. */
template <typename TFunction>
VarianceCurve
EvenCurve(TFunction excessAt)
{
  VarianceCurve curve{ MakeLine(), {} };
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    curve.bins.push_back(BinAt(2.0 * static_cast<double>(b) - 63.0, excessAt));
  }
  return curve;
}

/** Variances of pixels about a line, and the curve about the line that is fitted to them. */
VarianceCurve
CurveOfPixels(double gain, double wave)
{
  constexpr std::size_t            pixels = 20000;
  std::mt19937                     random(41);
  std::uniform_real_distribution<> uniform(100.0, 1100.0);
  std::chi_squared_distribution<>  chiSquare(30.0);
  std::vector<double>              mean;
  std::vector<double>              variance;
  const std::vector<float>         dof(pixels, 30.0F);
  const std::vector<std::uint8_t>  mask(pixels, 1);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    mean.push_back(uniform(random));
    variance.push_back((20.0 + gain * mean[p]) * (1.0 + wave * std::sin(0.03 * mean[p])) * chiSquare(random) / 30.0);
  }
  const std::vector<float> neighbourMean(mean.begin(), mean.end());
  VarianceFit fit({ mean.data(), neighbourMean.data(), { variance.data() }, dof.data(), mask.data(), pixels },
                  SerialFor,
                  std::nullopt);
  fit.Iterate(8);
  return fit.CurveAbout(fit.GetLine());
}
} // namespace

TEST(SensorNoiseVarianceCurve, LineHasNoDeviationFromItself)
{
  const VarianceCurve curve = EvenCurve([](double) { return 0.0; });
  EXPECT_EQ(curve.ReducedChi2(), 0.0);
  EXPECT_EQ(curve.ReducedChi2(4.0), 0.0);
  EXPECT_EQ(curve.Nonlinearity(1.0), 0.0);
  ASSERT_EQ(curve.FitHalves().size(), 4u);
  for (const SlopeExcess & half : curve.FitHalves())
  {
    EXPECT_EQ(half.value, 0.0);
  }
}

TEST(SensorNoiseVarianceCurve, NoiseAboutALineIsChance)
{
  const VarianceCurve curve = CurveOfPixels(0.05, 0.0);
  ASSERT_EQ(curve.bins.size(), VarianceCurve::Bins);
  EXPECT_NEAR(curve.ReducedChi2(), 1.0, 0.9); // 62 degrees of freedom: 5 standard deviations of sqrt(2 / 62)
  // The variance of a group of 1,250 pixels has the standard error sqrt(2 / 30 / 1250) = 0.73 %. 5 standard errors are
  // allowed, and 2 are subtracted as chance.
  EXPECT_LT(curve.Nonlinearity(1.0), std::sqrt(25.0 - 4.0) * 0.0073);
  for (const SlopeExcess & half : curve.FitHalves())
  {
    EXPECT_NEAR(half.value, 0.0, 5.0 * std::sqrt(half.variance));
    EXPECT_GT(half.variance, 0.0);
  }
}

TEST(SensorNoiseVarianceCurve, WaveInTheVarianceIsNoChance)
{
  const VarianceCurve curve = CurveOfPixels(0.05, 0.2);
  EXPECT_GT(curve.ReducedChi2(), 3.0);
  EXPECT_DOUBLE_EQ(curve.ReducedChi2(2.0), 0.5 * curve.ReducedChi2()); // all neighbours are in one bin
  EXPECT_DOUBLE_EQ(curve.ReducedChi2(1e9), 1.0);                       // some of them do
  EXPECT_GT(curve.Nonlinearity(1.0), 0.1);
  EXPECT_LT(curve.Nonlinearity(1.0), 0.2 + 5.0 * 0.0073);
}

TEST(SensorNoiseVarianceCurve, ParabolaHasTheSizeAndTheSlopesOfItsFormula)
{
  // c (x^2 - mean of x^2) at levels 2 DN apart is the residual of a parabola about its line.
  constexpr double    c = 0.01;
  constexpr double    meanSquare = 4.0 * (64.0 * 64.0 - 1.0) / 12.0;
  const VarianceCurve curve = EvenCurve([&](double x) { return c * (x * x - meanSquare); });
  // The darkest group, of four bins about x = -60, has the mean x^2 = 60^2 + 4 (0.5^2 + 1.5^2) / 2. It has the largest
  // relative deviation: the deviation of the brightest group is the same, and the line is higher there.
  const double atGroup = c * (60.0 * 60.0 + 5.0 - meanSquare);
  const double line = 20.0 + 0.5 * (PivotDn - 60.0);
  for (const double dispersion : { 1.0, 3.0 })
  {
    const double chance = 9.0 * dispersion / (4.0 * Weight); // three standard deviations
    EXPECT_NEAR(curve.Nonlinearity(dispersion), std::sqrt(atGroup * atGroup - chance) / line, 1e-12);
  }
  EXPECT_EQ(curve.Nonlinearity(1e9), 0.0); // all of it may be chance
  // The centre of a half, by count and by information, is 32 DN from the pivot, where the slope of the parabola is 2 c
  // x.
  const std::vector<SlopeExcess> halves = curve.FitHalves();
  ASSERT_EQ(halves.size(), 4u);
  const double ofHalf = 1.0 / (Weight * 4.0 * 32.0 * (32.0 * 32.0 - 1.0) / 12.0);
  const double ofAll = 1.0 / (Weight * 64.0 * meanSquare);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(halves[i].value, (i % 2 == 0 ? -2.0 : 2.0) * c * 32.0, 1e-12) << i;
    EXPECT_NEAR(halves[i].variance, ofHalf - ofAll, 1e-12 * ofHalf) << i;
  }
}

TEST(SensorNoiseVarianceCurve, HalvesOfTheInformationArePartedWhereItIs)
{
  // Nearly all information is in the 4 bright bins, not in the 60 dark bins. Half of it lies below the third bright
  // bin.
  VarianceCurve curve{ MakeLine(), {} };
  const auto    excessAt = [](double x) { return x < 1150.0 ? -0.1 * x : 0.3 * (x - 1150.0); };
  for (std::size_t b = 0; b < 64; ++b)
  {
    const auto x = static_cast<double>(b);
    curve.bins.push_back(BinAt(b < 60 ? x : 1000.0 + 100.0 * (x - 60.0), excessAt));
  }
  const std::vector<SlopeExcess> halves = curve.FitHalves();
  ASSERT_EQ(halves.size(), 4u);
  EXPECT_NEAR(halves[0].value, -0.1, 1e-12); // the darker half of the pixels
  EXPECT_NEAR(halves[2].value, -0.1, 1e-12);
  EXPECT_NEAR(halves[3].value, 0.3, 1e-12);
  // With two bright bins the brighter half of the information is at one level, which determines no slope.
  curve.bins.erase(curve.bins.begin() + 60, curve.bins.begin() + 62);
  EXPECT_EQ(curve.FitHalves().size(), 3u);
}

TEST(SensorNoiseVarianceCurve, GroupsOfLevelsHaveTheErrorOfIndependentBins)
{
  std::mt19937               random(43);
  std::normal_distribution<> normal(0.0, 1.0 / std::sqrt(Weight));
  constexpr int              curves = 400;
  double                     sum = 0.0;
  for (int k = 0; k < curves; ++k)
  {
    sum += EvenCurve([&](double) { return normal(random); }).SlopeVarianceByGroups();
  }
  const double information = Weight * 4.0 * (64.0 * 64.0 * 64.0 - 64.0) / 12.0; // levels 2 DN apart
  // A jackknife of 16 groups scatters by sqrt(2 / 15), and by more where groups have unequal leverage.
  EXPECT_NEAR(sum / curves * information, 1.0, 0.15);
}

TEST(SensorNoiseVarianceCurve, GroupsOfLevelsHoldDeviationsThatNeighboursShare)
{
  // The brightest eighth of the bins is 3 DN^2 above the line: its effect on the slope is nearly all in the error.
  const auto          excess = [](double x) { return x > 47.0 ? 3.0 : 0.0; };
  const VarianceCurve curve = EvenCurve(excess);
  double              information = 0.0;
  double              product = 0.0;
  for (const CurveBin & bin : curve.bins)
  {
    const double x = bin.x / bin.weight;
    information += bin.weight * x * x;
    product += bin.weight * x * excess(x);
  }
  const double error = std::sqrt(curve.SlopeVarianceByGroups());
  EXPECT_GT(error, 0.4 * product / information);
  EXPECT_GT(error, std::sqrt(curve.ReducedChi2() / information));
}

TEST(SensorNoiseVarianceCurve, GroupsOfOneLevelHaveNoError)
{
  const VarianceCurve two{ MakeLine(),
                           { BinAt(-1.0, [](double) { return 1.0; }), BinAt(1.0, [](double) { return 0.0; }) } };
  EXPECT_EQ(two.SlopeVarianceByGroups(), 0.0);
  EXPECT_EQ((VarianceCurve{ MakeLine(), {} }.SlopeVarianceByGroups()), 0.0);
}

TEST(SensorNoiseVarianceCurve, DarkestFractionIsARatioOfSignals)
{
  const VarianceCurve curve = EvenCurve([](double) { return 0.0; }); // from 437 to 563 DN
  EXPECT_NEAR(curve.DarkestFraction(413.0), 24.0 / 150.0, 1e-12);
  EXPECT_EQ(curve.DarkestFraction(450.0), 0.0); // no signal
  EXPECT_EQ(curve.DarkestFraction(600.0), 1.0); // no levels above black
  EXPECT_EQ((VarianceCurve{ MakeLine(), {} }.DarkestFraction(0.0)), 1.0);
}
