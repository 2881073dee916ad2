// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ReferenceFrame.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 1000;
constexpr std::size_t Frames = 37; // its quotients are not exact

/** Returns means over time of whole numbers from 0 to 65535, computed as in pass 1. */
std::vector<double>
MeansAbove(double centreDn)
{
  std::mt19937        random(3);
  std::vector<double> means(Pixels);
  std::generate(means.begin(), means.end(), [&] {
    const auto sum = static_cast<double>(random() % (65536 * Frames)) - centreDn * static_cast<double>(Frames);
    return sum / static_cast<double>(Frames) + centreDn;
  });
  return means;
}
} // namespace

TEST(SensorNoisePackedMeans, HaveTheBitsOfTheMeans)
{
  for (const double centreDn : { 0.0, 32768.0 })
  {
    const std::vector<double> expected = MeansAbove(centreDn);
    std::vector<double>       means = expected;
    PackedMeans               packed;
    packed.Pack(means, Frames, centreDn, test::Threads(3));
    ASSERT_FALSE(packed.IsEmpty());
    EXPECT_EQ(means.capacity(), 0u);
    std::vector<double> part(20);
    packed.Fill(part.data(), 500, part.size());
    EXPECT_TRUE(std::equal(part.begin(), part.end(), expected.begin() + 500));
    packed.Unpack(means, test::Threads(3));
    EXPECT_TRUE(packed.IsEmpty());
    EXPECT_EQ(means, expected);
  }
}

TEST(SensorNoisePackedMeans, MeansThatAreNoQuotientsStayAsTheyAre)
{
  for (const double other : { 0.5, 1e30, std::nan("") })
  {
    std::vector<double> means = MeansAbove(0.0);
    means[7] = other;
    PackedMeans packed;
    packed.Pack(means, Frames, 0.0, SerialFor);
    EXPECT_TRUE(packed.IsEmpty());
    EXPECT_EQ(means.size(), Pixels);
  }
}

TEST(SensorNoisePixelMap, RoundsToSinglePrecisionAndBack)
{
  const std::vector<double> expected = MeansAbove(0.0);
  PixelMap                  map = expected;
  map.Round(SerialFor);
  EXPECT_EQ(map.GetPrecision(), Precision::Single);
  map.Set(3, 1.0 / 3.0);
  EXPECT_EQ(map[3], static_cast<double>(1.0F / 3.0F));
  map.Set(3, expected[3]);
  map.Widen(test::Threads(3));
  ASSERT_EQ(map.GetDoubles().size(), Pixels);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    ASSERT_NEAR(map[p], expected[p], std::exp2(-24.0) * expected[p]) << p;
  }
}
