// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Eigen.h"
#include "correlation/FrameTimes.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/TotalCovariance.h"
#include "helpers/CorrelationTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 60;
constexpr double        Lag1 = 0.1; // coefficient of the recursion, which is the correlation of neighbouring frames

/** Returns the numbers 0, 1, ... of frames as recorded, without those at which \a isRepeat. */
template <typename TIsRepeat>
std::vector<std::size_t>
NumbersWithout(std::size_t recorded, TIsRepeat isRepeat)
{
  std::vector<std::size_t> numbers;
  for (std::size_t t = 0; t < recorded; ++t)
  {
    if (!isRepeat(t))
    {
      numbers.push_back(t);
    }
  }
  return numbers;
}

bool
IsEveryFifth(std::size_t t)
{
  return t % 5 == 4;
}

/** Returns the residuals of the noise n_t = a n_(t-1) + white noise, at \a times. */
NoiseResiduals
ResidualsAt(const std::vector<std::size_t> & times, double a)
{
  std::vector<DoubleFrame> frames{ NormalFrame(Geometry.width, Geometry.height, 1) };
  for (std::size_t t = 1; t <= times.back(); ++t)
  {
    DoubleFrame next = NormalFrame(Geometry.width, Geometry.height, t + 1);
    for (std::size_t p = 0; p < next.values.size(); ++p)
    {
      next.values[p] = a * frames.back().values[p] + std::sqrt(1.0 - a * a) * next.values[p];
    }
    frames.push_back(std::move(next));
  }
  return ComputeResiduals(
    Geometry, times.size(), Ramp(Geometry, 1.0, 2.0), [&](std::size_t t) { return frames[times[t]]; });
}

std::vector<std::size_t>
Consecutive(std::size_t frames)
{
  return NumbersWithout(frames, [](std::size_t) { return false; });
}
} // namespace

TEST(SensorNoiseFrameTimes, PairsAreOfFramesThatAreMeasured)
{
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  const FrameTimes times({ 3, 4, 6, 7, 10 });
  EXPECT_EQ(times.PairsAt(1, 5), (Pairs{ { 0, 1 }, { 2, 3 } }));
  EXPECT_EQ(times.PairsAt(3, 5), (Pairs{ { 0, 2 }, { 1, 3 }, { 3, 4 } }));
  EXPECT_EQ(times.PairsAt(5, 5), Pairs());
  EXPECT_EQ(times.Duration(5), 8U);
  EXPECT_TRUE(FrameTimes({ 3, 4, 5 }).AreConsecutive());
  EXPECT_EQ(FrameTimes().PairsAt(2, 4), (Pairs{ { 0, 2 }, { 1, 3 } }));
}

TEST(SensorNoiseFrameTimes, MixingIsTheSumOverThePairsOfTheProjectedCovariance)
{
  const std::vector<std::size_t> numbers = NumbersWithout(25, IsEveryFifth);
  const auto                     frames = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd                basis(frames, 2);
  basis.col(0).setConstant(1.0 / std::sqrt(static_cast<double>(frames)));
  basis.col(1) = Eigen::VectorXd::LinSpaced(frames, -1.0, 1.0).normalized();
  const Eigen::MatrixXd projection = ResidualProjection(basis);
  const FrameTimes      times(numbers);
  const Eigen::MatrixXd mixing = TemporalMixing(basis, 4, 7, times);
  for (std::size_t k = 0; k <= 7; ++k)
  {
    Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(frames, frames);
    for (const auto & [first, second] : times.PairsAt(k, numbers.size()))
    {
      const auto row = static_cast<Eigen::Index>(first);
      const auto column = static_cast<Eigen::Index>(second);
      shift(row, column) = shift(column, row) = 1.0;
    }
    const Eigen::MatrixXd covariance = projection * shift * projection;
    for (std::size_t d = 0; d <= 4; ++d)
    {
      double sum = 0.0;
      for (const auto & [first, second] : times.PairsAt(d, numbers.size()))
      {
        sum += covariance(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(second));
      }
      EXPECT_NEAR(mixing(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(k)), sum, 1e-12) << d << ", " << k;
    }
  }
}

TEST(SensorNoiseFrameTimes, CopiesInPlaceOfFramesKeepTheirTime)
{
  const std::vector<std::size_t> numbers = NumbersWithout(Frames, IsEveryFifth);
  NoiseResiduals                 residuals = ResidualsAt(numbers, Lag1);
  const NoiseCorrelation         without = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  residuals.SetTimes(FindFrameTimes(residuals, numbers, SerialFor));
  ASSERT_FALSE(residuals.GetTimes().AreConsecutive());
  const NoiseCorrelation found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
  EXPECT_NEAR(found.time[0].coefficient.value, Lag1, 4.5 * found.time[0].coefficient.standardError);
  // 1 + 2 (a + a^2 + ...)
  EXPECT_NEAR(found.timeFactor.value, (1.0 + Lag1) / (1.0 - Lag1), 4.5 * found.timeFactor.standardError);
  EXPECT_LT(found.timeFactor.standardError, 0.02);
  // A quarter of the pairs is two frames apart, which lowers the coefficient to 3/4 a + 1/4 a^2.
  EXPECT_NEAR(without.time[0].coefficient.value, 0.0775, 0.01);
}

TEST(SensorNoiseFrameTimes, InsertedCopiesHaveNoTime)
{
  const std::vector<std::size_t> numbers = NumbersWithout(Frames, IsEveryFifth);
  const NoiseResiduals           residuals = ResidualsAt(Consecutive(numbers.size()), Lag1);
  EXPECT_TRUE(FindFrameTimes(residuals, numbers, SerialFor).AreConsecutive());
}

TEST(SensorNoiseFrameTimes, WhiteNoiseShowsNoTime)
{
  const std::vector<std::size_t> numbers = NumbersWithout(Frames, IsEveryFifth);
  const NoiseResiduals           residuals = ResidualsAt(Consecutive(numbers.size()), 0.0);
  EXPECT_TRUE(FindFrameTimes(residuals, numbers, SerialFor).AreConsecutive());
  // Every frame was recorded twice: no pair shows what a copy stands for.
  std::vector<std::size_t> even = Consecutive(numbers.size());
  for (std::size_t & number : even)
  {
    number *= 2;
  }
  EXPECT_TRUE(FindFrameTimes(residuals, even, SerialFor).AreConsecutive());
}
