// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ProcessingSigns.h"
#include "simulation/Random.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
/** Numbers of values that are added with alternating signs. The excess of a sum of n values is 1/n of theirs. */
constexpr std::array<double, KurtosisSums::Kinds> Added{ 1.0, 2.0, 2.0, 4.0, 8.0, 8.0 };

std::vector<KurtosisSums>
SumKurtosis(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  const MixtureKurtosis normal(residuals);
  return OfTiles(residuals, parallelFor, [&](std::size_t i) { return KurtosisOfTile(residuals, i, normal, 0.0); });
}

JackknifeEstimate
Measure(const NoiseResiduals & residuals)
{
  return Jackknife(SumKurtosis(residuals, SerialFor), [](const KurtosisSums & sums) {
    return Eigen::VectorXd(
      Eigen::VectorXd::NullaryExpr(KurtosisSums::Kinds, [&](Eigen::Index k) { return sums.Excess(k); }));
  });
}

JackknifeEstimate
Measure(std::size_t frames, const FrameOf & noise, const Eigen::MatrixXd & series = {})
{
  return Measure(ComputeResiduals(Geometry, frames, Ramp(Geometry, 10.0, 200.0), noise, series));
}

template <typename TDraw>
FrameOf
Independent(TDraw draw)
{
  return [=](std::size_t t) {
    CounterSeededRandom random(6, 5, t);
    DoubleFrame         frame(Geometry.width, Geometry.height);
    for (double & value : frame.values)
    {
      value = draw(random);
    }
    return frame;
  };
}

/** Measures the excess of the upper tail. */
JackknifeEstimate
MeasureTail(std::size_t frames, const FrameOf & noise)
{
  const NoiseResiduals residuals = ComputeResiduals(Geometry, frames, Ramp(Geometry, 10.0, 200.0), noise);
  return Jackknife(SumKurtosis(residuals, SerialFor), [](const KurtosisSums & sums) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, sums.UpperTailExcess()));
  });
}

constexpr std::size_t ManyFrames = 200;

/** Cumulants of a distribution with the variance 1. */
struct Cumulants
{
  double fourth;
  double squareOfThird;
  double sixth;
};

void
ExpectExcess(const JackknifeEstimate & found, const Cumulants & of)
{
  constexpr double T = ManyFrames;
  for (std::size_t k = 0; k < Added.size(); ++k)
  {
    const double n = Added[k];
    const double excess = of.fourth / n;
    const double skewness = n > 1.0 ? 0.0 : of.squareOfThird; // signs alternate
    // To first order in 1 / T: the ratio of the moments of T values without their mean, over that ratio of normal
    // noise.
    const double fourth = 3.0 + excess;
    const double sixth = 15.0 + 15.0 * excess + 10.0 * skewness + of.sixth / (n * n);
    const double bias = (3.0 * fourth * fourth - fourth - 2.0 * sixth + 2.0 * fourth - 2.0 * excess) / T;
    const auto   index = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(found.value(index), excess + bias, 4.5 * found.StandardError(index) + 200.0 / (T * T) / n) << k;
    EXPECT_LT(found.StandardError(index), 0.02) << k;
  }
}
} // namespace

TEST(SensorNoiseNoiseKurtosis, NormalNoiseHasNoneHoweverFewTheFrames)
{
  for (const std::size_t frames : { 5, 8, 60 })
  {
    const auto found = Measure(frames, WhiteNoise(Geometry, 40 + frames));
    for (Eigen::Index k = 0; k < found.value.size(); ++k)
    {
      ExpectFigure(found, k, 0.0, 0.04);
    }
  }
}

TEST(SensorNoiseNoiseKurtosis, NormalNoiseHasNoneAfterSeriesThatAreNotEven)
{
  // The component of a single frame removes all information of this frame. The step is distributed over 4 of 10 frames.
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(10, 2);
  series(3, 0) = 1.0;
  series.col(1).head(4).setOnes();
  const auto found = Measure(10, WhiteNoise(Geometry, 51), series);
  for (Eigen::Index k = 0; k < found.value.size(); ++k)
  {
    ExpectFigure(found, k, 0.0, 0.04);
  }
}

TEST(SensorNoiseNoiseKurtosis, NormalNoiseHasNoneWhateverPixelsAndFilter)
{
  // Pixels of very different noise. Half of its right neighbour is added to each pixel.
  const auto white = WhiteNoise(Geometry, 3);
  const auto found = Measure(30, [&](std::size_t t) {
    DoubleFrame frame = white(t);
    for (std::size_t p = 0; p + 1 < frame.values.size(); ++p)
    {
      frame.values[p] = (1.0 + static_cast<double>(p % 7)) * (frame.values[p] + 0.5 * frame.values[p + 1]);
    }
    return frame;
  });
  for (Eigen::Index k = 0; k < found.value.size(); ++k)
  {
    ExpectFigure(found, k, 0.0, 0.04);
  }
}

TEST(SensorNoiseNoiseKurtosis, NormalNoiseHasItsTailHoweverFewTheFrames)
{
  for (const std::size_t frames : { 5, 12, 60 })
  {
    // The values in the tail are counted: 0.00023 of all, with a Poisson error.
    ExpectFigure(MeasureTail(frames, WhiteNoise(Geometry, 40 + frames)), 0, 0.0, 0.35);
  }
}

TEST(SensorNoiseNoiseKurtosis, RemovedOutliersAreMissingInTheTail)
{
  for (const std::size_t frames : { 12, 60 })
  {
    const auto cut = MeasureTail(frames, Independent([](CounterSeededRandom & random) {
                                   const double value = random.Normal();
                                   return value > 3.0 ? 0.0 : value;
                                 }));
    EXPECT_LT(cut.value(0), -0.5 - 4.0 * cut.StandardError(0)) << frames;
  }
}

TEST(SensorNoiseNoiseKurtosis, DeficitOfTheTailIsAsSignificantAsThePoissonDistributionSays)
{
  KurtosisSums sums;
  sums.values = 4.0 / 2.326290790355401e-4; // 4 values are expected above 3.5 standard deviations
  EXPECT_NEAR(sums.SignificanceOfDeficit(), std::sqrt(8.0), 1e-6); // P(0) = exp(-4)
  sums.inTail = 1.0;
  EXPECT_NEAR(sums.SignificanceOfDeficit(), std::sqrt(2.0 * (3.0 - std::log(4.0))), 1e-6);
  sums.inTail = 5.0;
  EXPECT_EQ(sums.SignificanceOfDeficit(), 0.0);
}

TEST(SensorNoiseNoiseKurtosis, UniformNoiseHasMinusSixFifthsAndSumsANthOfIt)
{
  const auto draw = [](CounterSeededRandom & random) { return random.Uniform(); };
  ExpectExcess(Measure(ManyFrames, Independent(draw)), { -1.2, 0.0, 48.0 / 7.0 });
}

TEST(SensorNoiseNoiseKurtosis, PoissonNoiseHasOneOverItsMeanAndSumsANthOfIt)
{
  constexpr double mean = 5.0;
  const auto       draw = [](CounterSeededRandom & random) { return static_cast<double>(random.Poisson(mean)); };
  ExpectExcess(Measure(ManyFrames, Independent(draw)), { 1.0 / mean, 1.0 / mean, 1.0 / (mean * mean) });
}

TEST(SensorNoiseNoiseKurtosis, CopiesOfAPixelAndPixelsLeftOutHaveNoSeries)
{
  // Rows of equal values: the difference of a pixel and its lower neighbour is rounding.
  const auto copies = [](std::size_t t) {
    DoubleFrame       frame(Geometry.width, Geometry.height);
    const DoubleFrame white = NormalFrame(Geometry.width, 1, 60 + t);
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      frame.values[p] = white.values[p % Geometry.width];
    }
    return frame;
  };
  auto       residuals = ComputeResiduals(Geometry, 20, Ramp(Geometry, 10.0, 200.0), copies);
  const auto seriesOf = [&](std::size_t kind) {
    double series = 0.0;
    for (const auto & tile : SumKurtosis(residuals, SerialFor))
    {
      series += tile.series[kind];
    }
    return series;
  };
  const auto tiles = static_cast<double>(residuals.GetTiles().origins.size());
  EXPECT_EQ(seriesOf(0), tiles * 32.0 * 32.0);
  EXPECT_EQ(seriesOf(1), tiles * 31.0 * 32.0);
  EXPECT_EQ(seriesOf(2), 0.0);
  EXPECT_EQ(seriesOf(3), 0.0);
  EXPECT_EQ(seriesOf(4), tiles * 25.0 * 32.0);

  std::vector<std::uint8_t> take(Geometry.Pixels(), 1);
  take[Geometry.width * 10 + 10] = 0; // in the first tile
  residuals.Take(take, SerialFor);
  EXPECT_EQ(seriesOf(0), tiles * 32.0 * 32.0 - 1.0);
  EXPECT_EQ(seriesOf(1), tiles * 31.0 * 32.0 - 2.0);
  EXPECT_EQ(seriesOf(4), tiles * 25.0 * 32.0 - 8.0);
}

TEST(SensorNoiseNoiseKurtosis, SameBitsForAnyNumberOfThreads)
{
  const auto residuals = ComputeResiduals(Geometry, 12, Ramp(Geometry, 10.0, 200.0), WhiteNoise(Geometry, 9));
  const auto serial = SumKurtosis(residuals, SerialFor);
  const auto threads = SumKurtosis(residuals, Threads(3));
  for (std::size_t i = 0; i < serial.size(); ++i)
  {
    EXPECT_EQ(serial[i].ratio, threads[i].ratio);
    EXPECT_EQ(serial[i].series, threads[i].series);
  }
}

// The weights of y_t = a x_t + b y_(t-1) are a b^k, and the weights of its differences are a and a (b - 1) b^(k-1).
TEST(SensorNoiseNoiseKurtosis, RatioBehindARecursionIsThatOfItsWeights)
{
  for (const double b : { 0.0, 0.2, 0.5, 0.8 })
  {
    const auto factorOf = [](const std::vector<double> & weights) {
      double squares = 0.0;
      double fourths = 0.0;
      for (const double weight : weights)
      {
        squares += weight * weight;
        fourths += std::pow(weight, 4);
      }
      return fourths / (squares * squares);
    };
    std::vector<double> values{ 1.0 };
    std::vector<double> differences{ 1.0 };
    for (int k = 1; k < 300; ++k)
    {
      values.push_back(values.back() * b);
      differences.push_back((b - 1.0) * std::pow(b, k - 1));
    }
    EXPECT_NEAR(KurtosisRatioOfRecursion(b), factorOf(differences) / factorOf(values), 1e-12) << b;
  }
  EXPECT_EQ(KurtosisRatioOfRecursion(-0.2), KurtosisRatioOfRecursion(0.0));
}
