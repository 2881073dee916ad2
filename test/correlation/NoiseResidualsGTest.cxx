// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
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
constexpr std::size_t   Frames = 30;

/** Returns a drift, a wave, and their sum, which is linearly dependent. */
Eigen::MatrixXd
Series()
{
  Eigen::MatrixXd series(Frames, 3);
  for (Eigen::Index t = 0; t < series.rows(); ++t)
  {
    const auto time = static_cast<double>(t);
    series.row(t) << time, std::sin(0.7 * time), time + std::sin(0.7 * time);
  }
  return series;
}

/** Returns frames in which each pixel has its own level and its own response to each temporal component. */
DoubleFrame
SceneFrame(std::size_t t)
{
  const Eigen::MatrixXd series = Series();
  DoubleFrame           frame(Geometry.width, Geometry.height);
  for (std::size_t p = 0; p < frame.values.size(); ++p)
  {
    const auto place = static_cast<double>(p);
    const auto row = static_cast<Eigen::Index>(t);
    frame.values[p] = 5.0 + std::cos(place) * series(row, 0) + std::sin(3.0 * place) * series(row, 1);
  }
  return frame;
}

/** Returns white noise whose variance is 10 DN^2 at the signal 0 and 50 DN^2 at the largest signal, 200 DN. */
double
VarianceAt(double signalDn)
{
  return 10.0 + 0.2 * signalDn;
}

DoubleFrame
ShotNoiseFrame(std::size_t t)
{
  const std::vector<double> signal = Ramp(Geometry, 0.0, 200.0);
  DoubleFrame               frame = NormalFrame(Geometry.width, Geometry.height, 300 + t);
  for (std::size_t p = 0; p < signal.size(); ++p)
  {
    frame.values[p] *= std::sqrt(VarianceAt(signal[p]));
  }
  return frame;
}

std::size_t
ValuesOf(const NoiseResiduals & residuals)
{
  return residuals.GetTiles().frames * residuals.GetTiles().Pixels();
}
} // namespace

TEST(SensorNoiseNoiseResiduals, BasisHoldsTheConstantAndWhatTheSeriesAdd)
{
  const auto residuals =
    ComputeResiduals(Geometry, Frames, Ramp(Geometry, 0.0, 200.0), WhiteNoise(Geometry, 1), Series());
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  ASSERT_EQ(basis.cols(), 3); // the third component is the sum of the others
  EXPECT_LT((basis.transpose() * basis - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-12);
  EXPECT_EQ(residuals.GetDof(), Frames - 3.0);
  EXPECT_LT((basis * (basis.transpose() * Series()) - Series()).norm(), 1e-10 * Series().norm());
  EXPECT_EQ(residuals.GetNumberOfPixels(), Geometry.Pixels());
}

TEST(SensorNoiseNoiseResiduals, AreOrthogonalToTheSeries)
{
  const auto residuals =
    ComputeResiduals(Geometry, Frames, Ramp(Geometry, 0.0, 200.0), WhiteNoise(Geometry, 1), Series());
  const std::size_t pixels = residuals.GetTiles().Pixels();
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    const Eigen::Map<const Eigen::MatrixXf> tile(
      residuals.OfTile(i), static_cast<Eigen::Index>(pixels), static_cast<Eigen::Index>(Frames));
    // Noise of 1 DN with 4 bytes: about 30 roundings of 6e-8.
    EXPECT_LT((tile.cast<double>() * residuals.GetBasis()).cwiseAbs().maxCoeff(), 1e-5) << i;
  }
}

TEST(SensorNoiseNoiseResiduals, NothingIsLeftOfASceneWithoutNoise)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 0.0, 200.0), SceneFrame, Series());
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    for (std::size_t k = 0; k < ValuesOf(residuals); ++k)
    {
      ASSERT_NEAR(residuals.OfTile(i)[k], 0.0, 1e-4); // values of up to 35 DN with 4 bytes
    }
  }
}

TEST(SensorNoiseNoiseResiduals, WeightsAreTheInverseVarianceAtThePixelSignal)
{
  const auto signal = Ramp(Geometry, 50.0, 250.0);
  const auto take = std::vector<std::uint8_t>(Geometry.Pixels(), 1);
  // The signal is measured from the dark offset, 50 DN.
  const NoiseResiduals residuals(
    SampleOf(Geometry, Frames, ShotNoiseFrame), Eigen::MatrixXd(), { signal, take, 50.0 }, SerialFor);
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    for (std::size_t p = 0; p < residuals.GetTiles().Pixels(); ++p)
    {
      const double zDn = residuals.SignalOf(i)[p];
      const auto   x = static_cast<double>(residuals.GetTiles().origins[i].x + p % residuals.GetTiles().side);
      ASSERT_NEAR(zDn, 200.0 * x / 127.0, 1e-4);
      // Bins of 512 pixels: 5 sqrt(2 / (512 x 29)) = 0.06. Half a bin at the ends is a signal of 3 DN, 0.06 of 10 DN^2.
      ASSERT_NEAR(residuals.WeightOf(i)[p] * VarianceAt(zDn), 1.0, 0.06 + (zDn < 4.0 ? 0.06 : 0.0)) << zDn;
    }
  }
}

TEST(SensorNoiseNoiseResiduals, SignalBinsRiseAndHoldAsManyPixels)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 0.0, 200.0), ShotNoiseFrame);
  std::array<std::size_t, NoiseResiduals::IntensityBins> counts{};
  std::array<float, NoiseResiduals::IntensityBins>       lowest;
  std::array<float, NoiseResiduals::IntensityBins>       highest;
  lowest.fill(1e9F);
  highest.fill(-1e9F);
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    for (std::size_t p = 0; p < residuals.GetTiles().Pixels(); ++p)
    {
      const std::size_t bin = residuals.BinOf(i)[p];
      ++counts.at(bin);
      lowest.at(bin) = std::min(lowest.at(bin), residuals.SignalOf(i)[p]);
      highest.at(bin) = std::max(highest.at(bin), residuals.SignalOf(i)[p]);
    }
  }
  for (std::size_t b = 0; b < counts.size(); ++b)
  {
    EXPECT_EQ(counts[b], Geometry.Pixels() / NoiseResiduals::IntensityBins);
    EXPECT_LE(b > 0 ? highest[b - 1] : 0.0F, lowest[b]);
  }
}

TEST(SensorNoiseNoiseResiduals, PixelsThatAreNotTakenHaveNoWeight)
{
  auto                      residuals = ComputeResiduals(Geometry, Frames, Ramp(Geometry, 0.0, 200.0), ShotNoiseFrame);
  std::vector<std::uint8_t> left(Geometry.Pixels());
  for (std::size_t p = 0; p < left.size(); ++p)
  {
    left[p] = p % Geometry.width < 64 ? 1 : 0;
  }
  residuals.Take(left, SerialFor);
  EXPECT_EQ(residuals.GetNumberOfPixels(), Geometry.Pixels() / 2);
  const auto & tiles = residuals.GetTiles();
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      ASSERT_EQ(residuals.WeightOf(i)[p] > 0.0F, tiles.origins[i].x + p % tiles.side < 64);
    }
  }
  residuals.Take(std::vector<std::uint8_t>(Geometry.Pixels(), 0), SerialFor);
  EXPECT_EQ(residuals.GetNumberOfPixels(), 0U);
}

TEST(SensorNoiseNoiseResiduals, WithoutTheFirstFramesTheyAreThoseOfTheRest)
{
  constexpr std::size_t dropped = 7;
  const auto            signal = Ramp(Geometry, 0.0, 200.0);
  const auto            noise = WhiteNoise(Geometry, 3);
  auto                  residuals = ComputeResiduals(Geometry, Frames, signal, noise, Series());
  residuals.DropFirst(dropped, Threads(3));
  const auto rest = ComputeResiduals(
    Geometry, Frames - dropped, signal, [&](std::size_t t) { return noise(t + dropped); }, Series().bottomRows(23));
  ASSERT_EQ(residuals.GetDof(), rest.GetDof());
  for (std::size_t i = 0; i < rest.GetTiles().origins.size(); ++i)
  {
    for (std::size_t k = 0; k < ValuesOf(rest); ++k)
    {
      ASSERT_NEAR(residuals.OfTile(i)[k], rest.OfTile(i)[k], 1e-5);
    }
  }
}
