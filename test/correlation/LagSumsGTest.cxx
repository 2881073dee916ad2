// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LagSums.h"
#include "correlation/TotalCovariance.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 24;

struct Weight
{
  std::size_t x;
  std::size_t y;
  double      value;
};

/** Returns white noise after a filter: each pixel is a weighted sum of pixels to the right and below. */
FrameOf
Filtered(const std::vector<Weight> & weights)
{
  return [=](std::size_t t) {
    const DoubleFrame white = NormalFrame(Geometry.width + 4, Geometry.height + 4, 700 + t);
    DoubleFrame       frame(Geometry.width, Geometry.height);
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      for (const Weight & weight : weights)
      {
        frame.values[p] += weight.value * white.Row(p / frame.width + weight.y)[p % frame.width + weight.x];
      }
    }
    return frame;
  };
}

/** Returns the coefficients of all blocks together, and last their sum over all lags of both signs. */
Eigen::VectorXd
CoefficientsOf(const std::vector<LagSums> & sums)
{
  Eigen::VectorXd figures(static_cast<Eigen::Index>(sums.size()) + 1);
  double          sum = 1.0;
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    const PairSums total = sums[k].Total();
    figures(static_cast<Eigen::Index>(k)) = total.covariance / total.pairs;
    sum += 2.0 * figures(static_cast<Eigen::Index>(k));
  }
  figures.tail<1>()(0) = sum;
  return figures;
}

/** Sums of all lags, which the jackknife adds. */
struct SumsOfLags : std::vector<LagSums>
{
  SumsOfLags &
  operator+=(const SumsOfLags & other)
  {
    this->resize(other.size());
    for (std::size_t k = 0; k < other.size(); ++k)
    {
      (*this)[k] += other[k];
    }
    return *this;
  }
};

JackknifeEstimate
Measure(const FrameOf & noise, const std::vector<Lag> & lags)
{
  const auto              residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 10.0, 200.0), noise);
  std::vector<SumsOfLags> tiles;
  for (auto & tile : SumLags(residuals, lags, SerialFor))
  {
    tiles.push_back({ std::move(tile) });
  }
  return Jackknife(tiles, [](const SumsOfLags & sums) { return CoefficientsOf(sums); });
}

/** Returns noise that is constant in square tiles of \a side pixels. The first tile begins \a phase pixels left of and
 * above the frame. The temporal components of the tiles are exactly orthogonal: +1 in one frame, -1 in the next. */
NoiseResiduals
ResidualsOfSquares(std::size_t side, std::size_t phase)
{
  constexpr FrameGeometry geometry{ 16, 16, 1 };
  const std::size_t       across = (15 + phase) / side + 1;
  return ComputeResiduals(geometry, 2 * across * across, Ramp(geometry, 10.0, 200.0), [=](std::size_t t) {
    DoubleFrame frame(16, 16);
    for (std::size_t p = 0; p < 256; ++p)
    {
      const std::size_t square = (p / 16 + phase) / side * across + (p % 16 + phase) / side;
      frame.values[p] = square != t / 2 ? 0.0 : t % 2 == 0 ? 1.0 : -1.0;
    }
    return frame;
  });
}
} // namespace

TEST(SensorNoiseLagSums, WhiteNoiseHasNoCorrelation)
{
  const auto found = Measure(Filtered({ { 0, 0, 1.0 } }), { { 1, 0, 0 }, { 0, 1, 0 }, { -2, 3, 0 }, { 0, 0, 1 } });
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    ExpectFigure(
      found, k, 0.0, 0.004); // 1 / sqrt(16000 pixels x 23 frames) = 0.0016, and 0.002 with the weights at the borders
  }
  // The sum of r_t r_(t + 1) over T frames without their mean is -(T - 1) / T; it is divided by T - 1.
  ExpectFigure(found, 3, -1.0 / Frames, 0.004);
}

TEST(SensorNoiseLagSums, ThreeTapsHaveCoefficientsOfTwoThirdsAndASixth)
{
  // The autocorrelation of the weights is (1, 4, 6, 4, 1) / 16, along the columns alone.
  const auto found = Measure(Filtered({ { 0, 0, 0.25 }, { 0, 1, 0.5 }, { 0, 2, 0.25 } }),
                             { { 0, 1, 0 }, { 0, 2, 0 }, { 0, 3, 0 }, { 1, 0, 0 }, { 1, 1, 0 } });
  ExpectFigure(found, 0, 2.0 / 3.0, 0.006);
  ExpectFigure(found, 1, 1.0 / 6.0, 0.006);
  ExpectFigure(found, 2, 0.0, 0.006);
  ExpectFigure(found, 3, 0.0, 0.006);
  ExpectFigure(found, 4, 0.0, 0.006);
}

TEST(SensorNoiseLagSums, DiagonalsAreNotMistakenForEachOther)
{
  // The noise of a pixel is correlated with its lower left neighbour: lag (-1, 1).
  const auto found = Measure(Filtered({ { 1, 0, 1.0 }, { 0, 1, 1.0 } }), { { -1, 1, 0 }, { 1, 1, 0 } });
  ExpectFigure(found, 0, 0.5, 0.006);
  ExpectFigure(found, 1, 0.0, 0.006);
}

TEST(SensorNoiseLagSums, RecursiveFilterCorrelatesNeighbouringFrames)
{
  const auto white = WhiteNoise(Geometry, 2);
  const auto mixed = [&](std::size_t t) {
    DoubleFrame       frame = white(t);
    const DoubleFrame last = white(t + 1);
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      frame.values[p] += last.values[p];
    }
    return frame;
  };
  // R = (2, 1), mixed by the subtraction of the mean.
  const auto            found = Measure(mixed, { { 0, 0, 1 } });
  const Eigen::MatrixXd mean = Eigen::MatrixXd::Constant(Frames, 1, 1.0 / std::sqrt(1.0 * Frames));
  const Eigen::Vector2d expected = TemporalMixing(mean, 1, 1) * Eigen::Vector2d(2.0, 1.0);
  ExpectFigure(found, 0, expected(1) / expected(0), 0.006);
}

TEST(SensorNoiseLagSums, SquaresOfEqualPixelsSumUpWhereverOneBegins)
{
  for (const std::size_t side : { 2, 3, 4 })
  {
    for (std::size_t phase = 0; phase < side; ++phase)
    {
      const auto       residuals = ResidualsOfSquares(side, phase);
      std::vector<Lag> lags;
      const int        reach = static_cast<int>(side) - 1;
      for (int y = 0; y <= reach; ++y)
      {
        for (int x = -reach; x <= reach; ++x)
        {
          if (y > 0 || x > 0)
          {
            lags.push_back({ x, y, 0 });
          }
        }
      }
      const auto tiles = SumLags(residuals, lags, SerialFor);
      ASSERT_EQ(tiles.size(), 1U);
      const Eigen::VectorXd found = CoefficientsOf(tiles[0]);
      for (std::size_t k = 0; k < lags.size(); ++k)
      {
        const double expected = (1.0 - std::abs(lags[k].x) / static_cast<double>(side)) *
                                (1.0 - std::abs(lags[k].y) / static_cast<double>(side));
        EXPECT_NEAR(found(static_cast<Eigen::Index>(k)), expected, 1e-6) << side << " " << phase << " " << k;
      }
      EXPECT_NEAR(found.tail<1>()(0), static_cast<double>(side * side), 1e-5) << side << " " << phase;
    }
  }
}

TEST(SensorNoiseLagSums, PairsAreSortedByTheSignalOfTheFirst)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 10.0, 200.0), Filtered({ { 0, 0, 1.0 } }));
  const auto sums = SumLags(residuals, { { 0, 0, 0 }, { 1, 0, 0 } }, SerialFor);
  LagSums    own;
  for (const auto & tile : sums)
  {
    own += tile[0];
  }
  double last = 0.0;
  for (const PairSums & bin : own.bins)
  {
    EXPECT_GT(bin.pairs, 0.0);
    EXPECT_NEAR(
      bin.covariance / bin.pairs, 1.0, 0.02); // 4.5 sqrt(2 / (4000 x 23)), and more with the weights at the borders
    EXPECT_GT(bin.signal / bin.constant, last);
    EXPECT_GE(bin.square * bin.constant, bin.signal * bin.signal);
    last = bin.signal / bin.constant;
  }
}

TEST(SensorNoiseLagSums, SameBitsForAnyNumberOfThreads)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 10.0, 200.0), WhiteNoise(Geometry, 4));
  const std::vector<Lag> lags{ { 0, 0, 0 }, { -1, 2, 0 }, { 0, 0, 3 } };
  const auto             serial = SumLags(residuals, lags, SerialFor);
  const auto             threads = SumLags(residuals, lags, Threads(3));
  for (std::size_t i = 0; i < serial.size(); ++i)
  {
    for (std::size_t k = 0; k < lags.size(); ++k)
    {
      EXPECT_EQ(serial[i][k].Total().covariance, threads[i][k].Total().covariance);
      EXPECT_EQ(serial[i][k].Total().signal, threads[i][k].Total().signal);
    }
  }
}
