// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// Parts of a frame with different gains, in tiles of known excess.

using namespace sensornoise;

namespace
{
constexpr std::size_t Side = 16;

/** Returns 16 x 16 tiles of a frame, each with its phases, whose excess is \a excess of the tile. All parts have the
 * levels of one scene. */
PartTiles
TilesOf(const std::function<double(const TileExcess &)> & excess)
{
  PartTiles tiles;
  for (std::size_t i = 0; i < Side * Side; ++i)
  {
    TileExcess tile;
    tile.x = (static_cast<double>(i % Side) + 0.5) / Side;
    tile.y = (static_cast<double>(i / Side) + 0.5) / Side;
    tile.pixels = 256.0;
    tile.levelDn = 100.0 + static_cast<double>(37 * i % 101);
    tile.shotFraction = 1.0 - 10.0 / tile.levelDn;
    tile.error = 0.01;
    tile.excess = excess(tile) + 0.01 * std::sin(static_cast<double>(i * i)); // scatter without relation to the parts
    tiles.places.push_back(tile);
    for (std::size_t phase = 0; phase < LargestPeriod * LargestPeriod; ++phase)
    {
      tile.phase = phase;
      tile.pixels = 16.0;
      tile.error = 0.04;
      tile.excess = excess(tile) + 0.04 * std::sin(static_cast<double>(i * i + 7 * phase));
      tiles.phases.push_back(tile);
    }
  }
  return tiles;
}
} // namespace

TEST(SensorNoiseGainByParts, UniformSensorHasNone)
{
  EXPECT_EQ(CompareParts(TilesOf([](const TileExcess &) { return 0.0; })).Larger(), nullptr);
}

TEST(SensorNoiseGainByParts, NonlinearResponseIsNoPart)
{
  // The excess depends on the level of a tile, not on its place.
  const auto curve = [](const TileExcess & tile) { return 0.001 * std::abs(tile.levelDn - 150.0); };
  EXPECT_EQ(CompareParts(TilesOf(curve)).Larger(), nullptr);
}

TEST(SensorNoiseGainByParts, FindsEachPartition)
{
  for (const PartitionKind & kind : PartitionTable)
  {
    if (kind.partition == Partition::SmoothField || kind.divided == Divided::Frames)
    {
      continue;
    }
    // All factors differ, so that no coarser partition has the same parts.
    const auto gainOf = [&](std::size_t part) { return 0.1 * std::cos(static_cast<double>(3 * part + part * part)); };
    const auto excess = [&](const TileExcess & tile) {
      return tile.shotFraction * gainOf(PartOf(kind.partition, tile.x, tile.y, tile.phase));
    };
    const GainByParts       found = CompareParts(TilesOf(excess));
    const PartGains * const gains = found.Larger();
    ASSERT_NE(gains, nullptr) << kind.name;
    EXPECT_EQ(gains->partition, kind.partition) << kind.name << ", " << KindOf(gains->partition).name;
    ASSERT_EQ(gains->excess.size(), kind.parts);
    double mean = 0.0;
    for (std::size_t k = 0; k < kind.parts; ++k)
    {
      mean += (1.0 + gainOf(k)) / static_cast<double>(kind.parts);
    }
    for (std::size_t k = 0; k < kind.parts; ++k)
    {
      EXPECT_NEAR(gains->excess[k], (1.0 + gainOf(k)) / mean - 1.0, 5.0 * gains->error[k]) << kind.name << ' ' << k;
    }
  }
}

TEST(SensorNoiseGainByParts, UnlikeReadNoiseIsNoGain)
{
  // Both halves have the same gain. At these levels the read noise is at most a tenth of the variance.
  const auto excess = [](const TileExcess & tile) { return (1.0 - tile.shotFraction) * (tile.x < 0.5 ? -0.4 : 0.4); };
  const GainByParts found = CompareParts(TilesOf(excess));
  ASSERT_TRUE(found.places);
  EXPECT_EQ(found.places->partition, Partition::LeftRight);
  EXPECT_EQ(found.places->size, 0.0);
  EXPECT_FALSE(found.places->Differ());
  EXPECT_TRUE(found.places->DarkVariancesDiffer());
  EXPECT_TRUE(found.places->DifferMuch());
  // 128 tiles per half with an error of 0.01 each determine 0.06 h within 0.001.
  EXPECT_NEAR(found.places->dark[1] - found.places->dark[0], 0.8, 0.8 * 0.1);
}

TEST(SensorNoiseGainByParts, RatiosAreOfThePartsToTheirMeanAndNotToTheLine)
{
  // The variance without signal is twice the line's in one half, and five times in the other: 3.5 times is the mean,
  // which the common curve of the levels takes in part.
  const auto excess = [](const TileExcess & tile) { return (1.0 - tile.shotFraction) * (tile.x < 0.5 ? 1.0 : 4.0); };
  const auto found = CompareParts(TilesOf(excess));
  ASSERT_TRUE(found.places);
  const PartGains & halves = *found.places;
  for (const double levelDn : { 110.0, 150.0, 190.0 })
  {
    const double dark = 10.0 / levelDn; // as in the tiles
    const double left = halves.RatioAt(0.25, 0.5, 0, 1.0 - dark, levelDn);
    const double right = halves.RatioAt(0.75, 0.5, 0, 1.0 - dark, levelDn);
    EXPECT_NEAR(left, (1.0 + dark) / (1.0 + 2.5 * dark), 0.005) << levelDn;
    EXPECT_NEAR(right, (1.0 + 4.0 * dark) / (1.0 + 2.5 * dark), 0.005) << levelDn;
  }
}

TEST(SensorNoiseGainByParts, TheirMeanIsOverThePixelsThatAreGiven)
{
  const FrameGeometry       geometry{ 64, 16, 1 };
  std::vector<std::uint8_t> mask(geometry.Pixels());
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = p % 64 < 32 || p % 2 == 0 ? 1 : 0; // twice as many on the left
  }
  PartGains halves;
  halves.partition = Partition::LeftRight;
  halves.excess = { -0.1, 0.1 };
  halves.dark = { -0.5, 0.5 };
  const auto ratios = [&] {
    return std::vector<double>{ halves.RatioAt(0.2, 0.5, 0, 0.4, 0.0), halves.RatioAt(0.8, 0.5, 0, 0.4, 0.0) };
  };
  const std::vector<double> before = ratios();
  halves.CentreOn(mask, geometry);
  // The mean over the pixels is 0, and the halves differ by as much as before.
  EXPECT_NEAR(2.0 * halves.excess[0] + halves.excess[1], 0.0, 1e-12);
  EXPECT_NEAR(2.0 * halves.dark[0] + halves.dark[1], 0.0, 1e-12);
  EXPECT_NEAR(halves.meanDark, -0.5 / 3.0, 1e-12);
  EXPECT_NEAR(ratios()[1] / ratios()[0], before[1] / before[0], 1e-12);
}

TEST(SensorNoiseGainByParts, ReadNoiseThatGrowsAcrossTheFrameIsASmoothFieldAndNoGain)
{
  const auto        darkAt = [](const TileExcess & tile) { return 0.8 * (tile.x + tile.y * tile.y - 5.0 / 6.0); };
  const auto        excess = [&](const TileExcess & tile) { return (1.0 - tile.shotFraction) * darkAt(tile); };
  const GainByParts found = CompareParts(TilesOf(excess));
  ASSERT_TRUE(found.places);
  EXPECT_EQ(found.places->partition, Partition::SmoothField);
  EXPECT_EQ(found.places->size, 0.0);
  EXPECT_FALSE(found.places->Differ());
  EXPECT_TRUE(found.places->DifferMuch());
  TileExcess near;
  TileExcess far;
  near.x = near.y = 0.1;
  far.x = far.y = 0.9;
  const double difference =
    found.places->RatioAt(far.x, far.y, 0, 0.0, 100.0) - found.places->RatioAt(near.x, near.y, 0, 0.0, 100.0);
  // As in the test before, with 15 coefficients in place of 2 for 256 tiles: 7.5 times the variance.
  EXPECT_NEAR(difference, darkAt(far) - darkAt(near), 0.3 * (darkAt(far) - darkAt(near)));
}

TEST(SensorNoiseGainByParts, ErrorsOfTheRatiosAreErrorsOfTheLine)
{
  // Each half of the frame has one level. With the dark variance D, an excess h of each half, known to s, and the
  // levels a and b, the line through the two points has the gain's error sqrt(2) s D / (b - a).
  constexpr double                d = 9.0;
  constexpr double                a = 100.0;
  constexpr double                b = 300.0;
  constexpr double                s = 0.1;
  const FrameGeometry             geometry{ 32, 32 };
  std::vector<double>             mean(geometry.Pixels());
  const std::vector<std::uint8_t> mask(geometry.Pixels(), 1);
  for (std::size_t p = 0; p < mean.size(); ++p)
  {
    mean[p] = p % geometry.width < geometry.width / 2 ? a : b;
  }
  VarianceData data;
  data.mean = mean.data();
  data.mask = mask.data();
  data.pixels = mean.size();
  PartReference reference;
  reference.blackDn = 60.0;
  reference.line.gain = 0.5;
  reference.line.intercept = d - reference.line.gain * reference.blackDn;
  const double va = reference.line.At(a);
  const double vb = reference.line.At(b);
  reference.line.pivotDn = (a / (va * va) + b / (vb * vb)) / (1.0 / (va * va) + 1.0 / (vb * vb));

  PartGains halves;
  halves.partition = Partition::LeftRight;
  halves.excess = halves.dark = { 0.0, 0.0 };
  halves.darkCovariance = Eigen::Vector2d(s * s, s * s).asDiagonal();
  halves.meanOfTerms = Eigen::Vector2d(0.5, 0.5);
  const Eigen::Matrix2d covariance = CovarianceByRatios({ halves }, data, geometry, reference, SerialFor);
  EXPECT_NEAR(covariance(0, 0), 2.0 * std::pow(s * d / (b - a), 2), 1e-12);
  // The excess of both halves together does not matter: at the middle of the levels no variance changes.
  const Eigen::Vector2d atMiddle(0.5 * (a + b), 1.0);
  EXPECT_NEAR(atMiddle.dot(covariance * atMiddle), 0.0, 1e-9);
  EXPECT_TRUE(CovarianceByRatios({}, data, geometry, reference, SerialFor).isZero(0.0));
}

// Halves whose variances without signal differ by 10 %, 5 standard errors, are too much alike to be found, but are more
// probable than one part. The square of the difference is an error. Without a difference, little is.
TEST(SensorNoiseGainByParts, DifferencesThatAreNotFoundAreErrors)
{
  const auto covarianceOf = [](double difference) {
    const auto excess = [&](const TileExcess & tile) {
      return (1.0 - tile.shotFraction) * (tile.x < 0.5 ? -0.5 : 0.5) * difference;
    };
    const PartTiles tiles = TilesOf(excess);
    EXPECT_FALSE(CompareParts(tiles).places);
    const std::vector<PartGains> possible = FindPossibleParts(tiles.places);
    EXPECT_EQ(possible.size(), 3U);
    EXPECT_EQ(possible.front().partition, Partition::LeftRight);
    const Eigen::Vector2d contrast(-1.0, 1.0);
    return contrast.dot(possible.front().darkCovariance * contrast);
  };
  constexpr double difference = 0.1;
  // 128 tiles per half, with errors of 0.01 and 7 % of the variance without signal, know the difference to 0.02.
  EXPECT_GT(covarianceOf(difference), 0.5 * std::pow(difference - 2.0 * 0.02, 2));
  EXPECT_LT(covarianceOf(difference), std::pow(difference + 3.0 * 0.02, 2));
  EXPECT_LT(covarianceOf(0.0), 0.2 * std::pow(2.0 * 0.02, 2));
}

// Without dark areas, a gain and a read noise that change with the time are alike. Cameras change the gain.
TEST(SensorNoiseGainByParts, UnlikeFramesOfABrightSceneDifferInTheirGain)
{
  const auto tilesOf = [](double difference) {
    std::vector<TileExcess> tiles;
    for (std::size_t i = 0; i < 64 * FrameGroups; ++i)
    {
      TileExcess tile;
      tile.phase = i % FrameGroups;
      tile.pixels = 256.0;
      tile.levelDn = 300.0 + static_cast<double>(37 * (i / FrameGroups) % 101);
      tile.shotFraction = 1.0 - 10.0 / tile.levelDn;
      tile.error = 0.02;
      tile.excess = (tile.phase < FrameGroups / 2 ? -0.5 : 0.5) * difference * tile.shotFraction +
                    0.02 * std::sin(static_cast<double>(i * i));
      tiles.push_back(tile);
    }
    return tiles;
  };
  EXPECT_FALSE(CompareFrameParts(tilesOf(0.0)));
  const auto found = CompareFrameParts(tilesOf(0.05));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->partition, Partition::FrameHalves);
  EXPECT_NEAR(found->excess[1] - found->excess[0], 0.05, 4.0 * 2.0 * found->error[1]);
}

TEST(SensorNoiseGainByParts, NamesOfPartsDiffer)
{
  for (const PartitionKind & kind : PartitionTable)
  {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < kind.parts; ++k)
    {
      names.push_back(NameOfPart(kind.partition, k));
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << kind.name;
  }
}
