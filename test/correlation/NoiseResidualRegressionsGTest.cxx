// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

// The common component of the pixels of a row or a column of a frame is subtracted.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 30;

std::vector<double>
Signal()
{
  return Ramp(Geometry, 50.0, 250.0);
}

/** Returns white noise of 1 DN. The illumination of each row changes by the rms \a sd [1], and its dark offset by the
 * rms 100 \a sd [DN]. */
FrameOf
NoiseUnderRows(double sd)
{
  const auto noise = WhiteNoise(Geometry, 5);
  return [=](std::size_t t) {
    DoubleFrame       frame = noise(t);
    const DoubleFrame changes = NormalFrame(2, Geometry.height, 77 + t);
    const auto        signal = Signal();
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      const std::size_t y = p / Geometry.width;
      frame.values[p] += sd * changes.values[2 * y] * signal[p] + 100.0 * sd * changes.values[2 * y + 1];
    }
    return frame;
  };
}

const std::vector<std::uint8_t> All(Geometry.Pixels(), 1);

NoiseResiduals
WithoutRows(double sd, std::vector<float> & left, const ParallelFor & parallelFor = SerialFor)
{
  auto residuals = ComputeResiduals(Geometry, Frames, Signal(), NoiseUnderRows(sd));
  left = residuals.SubtractLines(LineAxis::Rows, All, parallelFor);
  return residuals;
}

template <typename TFunction>
void
ForValues(const NoiseResiduals & residuals, TFunction function)
{
  const std::size_t values = Frames * residuals.GetTiles().Pixels();
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    for (std::size_t k = 0; k < values; ++k)
    {
      function(i, k);
    }
  }
}
} // namespace

TEST(SensorNoiseNoiseResidualRegressions, IlluminationOfRowsIsRemoved)
{
  std::vector<float>   left;
  const NoiseResiduals uniform = WithoutRows(0.0, left);
  const NoiseResiduals lit = WithoutRows(0.05, left); // up to 12 DN
  double               square = 0.0;
  double               count = 0.0;
  ForValues(uniform, [&](std::size_t i, std::size_t k) {
    const double difference = static_cast<double>(lit.OfTile(i)[k]) - static_cast<double>(uniform.OfTile(i)[k]);
    square += difference * difference;
    count += 1.0;
  });
  // The weights differ by their errors, at most 3 % for bins of 256 pixels. At a leverage of 2 / 128 this is
  // negligible.
  EXPECT_LT(std::sqrt(square / count), 0.01);
}

TEST(SensorNoiseNoiseResidualRegressions, VarianceStays)
{
  std::vector<float>   left;
  const NoiseResiduals residuals = WithoutRows(0.05, left);
  double               squares = 0.0;
  double               leverage = 0.0;
  const std::size_t    pixels = residuals.GetTiles().Pixels();
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    for (std::size_t p = 0; p < pixels; ++p)
    {
      squares += static_cast<double>(residuals.SquaresOf(i)[p]);
      leverage += 1.0 - static_cast<double>(left[i * pixels + p]);
    }
  }
  const auto count = static_cast<double>(left.size());
  EXPECT_NEAR(leverage / count, 2.0 / 128.0, 1e-4); // two parameters per row of four tiles
  const double variance = squares / residuals.GetDof() / count;
  EXPECT_NEAR(variance, 1.0, 4.0 * std::sqrt(2.0 / (residuals.GetDof() * count)));
}

TEST(SensorNoiseNoiseResidualRegressions, RowsOfOneLevelLoseTheirMeanAlone)
{
  std::vector<float> left;
  auto               residuals =
    ComputeResiduals(Geometry, Frames, std::vector<double>(Geometry.Pixels(), 100.0), WhiteNoise(Geometry, 6));
  left = residuals.SubtractLines(LineAxis::Rows, All, SerialFor);
  EXPECT_NEAR(left.front(), 1.0 - 1.0 / 128.0, 1e-6);
}

TEST(SensorNoiseNoiseResidualRegressions, RowsWithoutPixelsAreSkipped)
{
  auto                      residuals = ComputeResiduals(Geometry, Frames, Signal(), NoiseUnderRows(0.05));
  std::vector<std::uint8_t> take = All;
  std::fill_n(take.begin(), Geometry.width, std::uint8_t{ 0 });
  const std::vector<float> left = residuals.SubtractLines(LineAxis::Rows, take, SerialFor);
  EXPECT_EQ(left.front(), 0.0F);
  EXPECT_GT(left[residuals.GetTiles().side], 0.9F);
}

TEST(SensorNoiseNoiseResidualRegressions, ThreadsGiveTheSameBits)
{
  std::vector<float>   ofOne;
  std::vector<float>   ofThree;
  const NoiseResiduals one = WithoutRows(0.05, ofOne);
  const NoiseResiduals three = WithoutRows(0.05, ofThree, Threads(3));
  EXPECT_EQ(ofOne, ofThree);
  ForValues(one, [&](std::size_t i, std::size_t k) { ASSERT_EQ(one.OfTile(i)[k], three.OfTile(i)[k]); });
}

TEST(SensorNoiseNoiseResidualRegressions, ColumnsOfTheTransposedFrameAreItsRows)
{
  const auto transposed = [](const std::vector<double> & values) {
    std::vector<double> other(values.size());
    for (std::size_t p = 0; p < values.size(); ++p)
    {
      other[p % Geometry.width * Geometry.width + p / Geometry.width] = values[p];
    }
    return other;
  };
  const auto frameOf = NoiseUnderRows(0.05);
  auto       turned = ComputeResiduals(Geometry, Frames, transposed(Signal()), [&](std::size_t t) {
    DoubleFrame frame = frameOf(t);
    frame.values = transposed(frame.values);
    return frame;
  });
  turned.SubtractLines(LineAxis::Columns, All, SerialFor);
  std::vector<float>   left;
  const NoiseResiduals rows = WithoutRows(0.05, left);
  const SampleTiles &  tiles = rows.GetTiles();
  double               largest = 0.0;
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    const auto other =
      static_cast<std::size_t>(std::find_if(tiles.origins.begin(),
                                            tiles.origins.end(),
                                            [&](const SampleTiles::Origin & origin) {
                                              return origin.x == tiles.origins[i].y && origin.y == tiles.origins[i].x;
                                            }) -
                               tiles.origins.begin());
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const std::size_t mirrored = p % tiles.side * tiles.side + p / tiles.side;
      largest = std::max(largest, std::abs(static_cast<double>(rows.OfTile(i)[p] - turned.OfTile(other)[mirrored])));
    }
  }
  EXPECT_LT(largest, 1e-3); // the weights are of bins whose pixels are sorted in another order
}
