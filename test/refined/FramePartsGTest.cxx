// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/ReportTestHelper.h"
#include "pixels/GainByParts.h"
#include "sensornoise/ReportText.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// Groups of frames with different gains, in tiles of known squares.

using namespace sensornoise;

namespace
{
constexpr Eigen::Index Frames = 40;
constexpr Eigen::Index Tiles = 20;
constexpr double       PixelsOfTile = 1000.0;
constexpr double       Gain = 0.5;            // [DN/e-]
constexpr double       ReadDn2 = 4.0;         // [DN^2]
constexpr double       OffsetDn = 100.0;      // [DN]
constexpr double       LargestFraction = 0.9; // fraction of the signal that the darkest tile lacks [1]

VarianceLine
Line()
{
  VarianceLine line;
  line.gain = Gain;
  line.intercept = ReadDn2 - Gain * OffsetDn;
  line.isDetermined = true;
  return line;
}

TileLevels
LevelsOfFrames()
{
  return { std::vector<double>(Frames, 0.0), OffsetDn, OffsetDn };
}

/** Returns the energies of tiles whose shot noise in frame t is \a gainOf(t) times the shot noise of the line, and
 * whose noise without signal is \a darkOf(t) times the noise of the line. All frames have one level. The squares
 * scatter by chance. */
template <typename TFunction, typename TDark>
FrameEnergies
EnergiesOf(TFunction gainOf, TDark darkOf)
{
  const Eigen::MatrixXd basis = Eigen::MatrixXd::Constant(Frames, 1, 1.0 / std::sqrt(static_cast<double>(Frames)));
  Eigen::MatrixXd       squares = Eigen::MatrixXd::Zero(Tiles, Frames);
  Eigen::VectorXd       signal(Tiles);
  const Eigen::VectorXd pixels = Eigen::VectorXd::Constant(Tiles, PixelsOfTile);
  const FrameEnergies   model(squares, signal, pixels, basis);
  CounterSeededRandom   random(5, 0, 0);
  for (Eigen::Index i = 0; i < Tiles; ++i)
  {
    signal(i) = 1000.0 * (1.0 - LargestFraction * static_cast<double>(i) / static_cast<double>(Tiles));
    Eigen::VectorXd variances(Frames);
    for (Eigen::Index t = 0; t < Frames; ++t)
    {
      variances(t) = darkOf(t) * ReadDn2 + gainOf(t) * Gain * signal(i);
    }
    squares.row(i) = model.ExpectedSquares(variances).transpose();
    for (Eigen::Index t = 0; t < Frames; ++t)
    {
      squares(i, t) *= 1.0 + std::sqrt(2.0 / PixelsOfTile) * random.Normal();
    }
  }
  return { squares, signal, pixels, basis };
}

template <typename TFunction>
std::vector<TileExcess>
TilesOf(TFunction gainOf)
{
  const FrameEnergies energies = EnergiesOf(gainOf, [](Eigen::Index) { return 1.0; });
  return MakeFrameParts(energies, LevelsOfFrames(), { Line(), OffsetDn, 1.0 });
}

template <typename TFunction, typename TDark>
GainsOfFrames
GainsBy(TFunction gainOf, TDark darkOf)
{
  return CompareGainsOfFrames(EnergiesOf(gainOf, darkOf), LevelsOfFrames(), { Line(), OffsetDn, 1.0 }, 0.001);
}

double
One(Eigen::Index)
{
  return 1.0;
}
} // namespace

TEST(SensorNoiseFrameParts, AreWhatTheLevelsMakeOfEqualFrames)
{
  const std::vector<TileExcess> tiles = TilesOf([](Eigen::Index) { return 1.0; });
  ASSERT_EQ(tiles.size(), FrameGroups * static_cast<std::size_t>(Tiles));
  double chi2 = 0.0;
  for (const TileExcess & tile : tiles)
  {
    EXPECT_NEAR(tile.excess, 0.0, 5.0 * tile.error);
    EXPECT_NEAR(tile.error, std::sqrt(2.0 / (5.0 * PixelsOfTile)), 0.01 * tile.error); // five frames per group
    EXPECT_NEAR(tile.shotFraction, 1.0 - ReadDn2 / (ReadDn2 + Gain * (tile.levelDn - OffsetDn)), 1e-9);
    chi2 += std::pow(tile.excess / tile.error, 2);
  }
  const auto count = static_cast<double>(tiles.size());
  EXPECT_NEAR(chi2 / count, 1.0, 5.0 * std::sqrt(2.0 / count));
  EXPECT_FALSE(CompareFrameParts(tiles));
}

TEST(SensorNoiseFrameParts, FindTheGainsOfEachPartition)
{
  const auto expect = [](Partition partition, const std::vector<double> & gains) {
    const auto found = CompareFrameParts(TilesOf([&](Eigen::Index t) {
      const auto group = static_cast<std::size_t>(2 * (4 * t / Frames) + t % 2);
      return gains[PartOf(partition, 0.0, 0.0, group)];
    }));
    ASSERT_TRUE(found) << KindOf(partition).name;
    EXPECT_EQ(found->partition, partition) << KindOf(found->partition).name;
    double mean = 0.0;
    for (const double gain : gains)
    {
      mean += gain / static_cast<double>(gains.size());
    }
    for (std::size_t k = 0; k < gains.size(); ++k)
    {
      EXPECT_NEAR(found->excess[k], gains[k] / mean - 1.0, 4.5 * found->error[k]) << KindOf(partition).name << k;
      EXPECT_LT(found->error[k], 0.01);
    }
  };
  expect(Partition::FrameHalves, { 0.98, 1.02 });
  expect(Partition::FrameQuarters, { 0.95, 1.03, 0.99, 1.05 });
  expect(Partition::FrameParities, { 1.03, 0.97 });
}

TEST(SensorNoiseFrameParts, AreFoundBesideIlluminationThatChangesFromLeftToRight)
{
  // Between the first and the last frame the illumination changes by 5 %, in opposite directions at both borders.
  const auto measure = [](double gainDrift) {
    constexpr std::size_t width = 160;
    constexpr std::size_t height = 128;
    test::Stack<double>   stack{ width, height, Frames, {} };
    CounterSeededRandom   random(6, 0, 0);
    for (std::size_t t = 0; t < stack.frames; ++t)
    {
      const double time = static_cast<double>(t) / (Frames - 1.0) - 0.5;
      for (std::size_t p = 0; p < width * height; ++p)
      {
        const double x = static_cast<double>(p % width) / width - 0.5;
        const double y = static_cast<double>(p / width) / height - 0.5;
        const double light = 4000.0 * (1.05 + std::sin(9.0 * y) * std::cos(8.0 * x)) * (1.0 + 0.1 * time * x);
        const double charge = light + std::sqrt(light) * random.Normal();
        stack.pixels.push_back(
          std::round(OffsetDn + Gain * (1.0 + gainDrift * time) * charge + std::sqrt(ReadDn2) * random.Normal()));
      }
    }
    return test::Measure(stack.Map<unsigned short>([](double u) { return u; }), RefinedSettings()).GetReport();
  };
  const Report steady = measure(0.0);
  EXPECT_TRUE(test::HasWarning(steady, WarningCode::LocalLight));
  EXPECT_FALSE(test::HasWarning(steady, WarningCode::GainNotUniform));
  const Report drifting = measure(0.2);
  EXPECT_TRUE(test::HasWarning(drifting, WarningCode::LocalLight));
  EXPECT_TRUE(test::HasWarning(drifting, WarningCode::GainNotUniform));
}

TEST(SensorNoiseFrameParts, OfADifferenceThatDoesNotCountAreOne)
{
  EXPECT_FALSE(CompareFrameParts(TilesOf([](Eigen::Index t) { return t < Frames / 2 ? 0.995 : 1.005; })));
}

TEST(SensorNoiseFrameParts, AreTheFramesOfEitherGain)
{
  const auto gainOf = [](Eigen::Index t) { return t % 3 == 2 ? 1.08 : 1.0; };
  const auto found = GainsBy(gainOf, One);
  EXPECT_TRUE(found.Differ());
  ASSERT_TRUE(found.areGroups);
  ASSERT_EQ(found.groups.size(), 2U);
  const double mean = 1.0 + 0.08 * 13.0 / 40.0;
  for (const std::size_t k : { 0, 1 })
  {
    const FrameGroup & group = found.groups[k];
    const double       gain = k == 0 ? 1.0 : 1.08;
    EXPECT_EQ(group.frames.size(), k == 0 ? 27U : 13U);
    EXPECT_NEAR(group.noise, gain / mean, 4.5 * std::hypot(found.error / std::sqrt(13.0), 0.05 * found.errorOfScale));
    for (const std::size_t t : group.frames)
    {
      EXPECT_EQ(t % 3 == 2, k == 1) << t;
    }
  }
  EXPECT_LT(found.error, 0.02);
}

TEST(SensorNoiseFrameParts, AreTheLowestAndTheHighestOfGainsThatVary)
{
  const auto found = GainsBy([](Eigen::Index t) { return 1.0 + 0.09 * std::sin(1.7 * static_cast<double>(t)); }, One);
  EXPECT_TRUE(found.Differ());
  EXPECT_FALSE(found.areGroups);
  ASSERT_EQ(found.groups.size(), 2U);
  EXPECT_NEAR(found.groups[0].noise, 0.91, 0.03);
  EXPECT_NEAR(found.groups[1].noise, 1.09, 0.03);
  EXPECT_NEAR(found.size, 0.09 / std::sqrt(2.0), 0.01);
}

TEST(SensorNoiseFrameParts, OfEqualGainsAreNotDivided)
{
  EXPECT_FALSE(GainsBy(One, One).Differ());
  EXPECT_FALSE(GainsBy([](Eigen::Index t) { return t % 3 == 2 ? 1.005 : 1.0; }, One).Differ());
  // The read noise alone differs: the excess is not in proportion to the shot noise.
  EXPECT_FALSE(GainsBy(One, [](Eigen::Index t) { return t % 3 == 2 ? 4.0 : 1.0; }).Differ());
}

TEST(SensorNoiseFrameParts, OfEveryThirdFrameAreInTheIntervalOfTheGain)
{
  constexpr std::size_t width = 160;
  constexpr std::size_t height = 128;
  test::Stack<double>   stack{ width, height, Frames, {} };
  CounterSeededRandom   random(7, 0, 0);
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const double more = t % 3 == 2 ? 1.08 : 1.0; // with as much less light
    for (std::size_t p = 0; p < width * height; ++p)
    {
      const double x = static_cast<double>(p % width) / width - 0.5;
      const double y = static_cast<double>(p / width) / height - 0.5;
      const double light = 4000.0 * (1.05 + std::sin(9.0 * y) * std::cos(8.0 * x)) / more;
      const double charge = light + std::sqrt(light) * random.Normal();
      stack.pixels.push_back(std::round(OffsetDn + Gain * more * charge + std::sqrt(ReadDn2) * random.Normal()));
    }
  }
  const Report report =
    test::Measure(stack.Map<unsigned short>([](double u) { return u; }), RefinedSettings()).GetReport();
  EXPECT_TRUE(test::HasWarning(report, WarningCode::GainNotUniform)) << ToJson(report);
  ASSERT_TRUE(report.gain.interval95);
  EXPECT_LT(*report.gain.interval95->low, Gain);
  EXPECT_GT(*report.gain.interval95->high, 1.08 * Gain);
  ASSERT_EQ(report.gainByParts.size(), 1U);
  EXPECT_EQ(report.gainByParts.front().pattern, "frames");
}
