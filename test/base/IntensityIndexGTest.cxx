// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
/** Means and a mask. Every seventh pixel is masked, and its mean is arbitrary. */
struct Scene
{
  std::vector<double>       mean;
  std::vector<std::uint8_t> mask;

  explicit Scene(std::vector<double> values)
    : mean(std::move(values))
    , mask(mean.size(), 1)
  {
    for (std::size_t p = 3; p < mean.size(); p += 7)
    {
      mask[p] = 0;
      mean[p] = p % 2 == 0 ? -1e6 : 1e6;
    }
  }
  IntensityIndex
  Index() const
  {
    return IntensityIndex(mean.data(), mask.data(), mean.size());
  }
  std::vector<double>
  Sorted() const
  {
    std::vector<double> values;
    for (std::size_t p = 0; p < mean.size(); ++p)
    {
      if (mask[p] != 0)
      {
        values.push_back(mean[p]);
      }
    }
    std::sort(values.begin(), values.end());
    return values;
  }
};

enum class Kind
{
  Uniform,
  Clustered,
  Tied,
  Lattice
};

Scene
RandomScene(Kind kind, std::size_t pixels, std::uint64_t seed)
{
  std::mt19937_64                  random(seed);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  std::vector<double>              values(pixels);
  for (double & value : values)
  {
    const double u = uniform(random);
    switch (kind)
    {
      case Kind::Uniform:
        value = 100.0 + 4000.0 * u;
        break;
      case Kind::Clustered: // two narrow heaps far apart: nearly all of the histogram's cells are empty
        value = u < 0.5 ? 1e-3 * u : 1e4 + 1e-3 * u;
        break;
      case Kind::Tied:
        value = std::floor(5.0 * u);
        break;
      case Kind::Lattice: // values on the edges of the histogram's cells
        value = 0.1 * static_cast<double>(random() % 65537);
        break;
    }
  }
  return Scene(std::move(values));
}

/** Linear between the order statistics of sorted values. */
double
QuantileOfSorted(const std::vector<double> & sorted, double q)
{
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto   below = static_cast<std::size_t>(position);
  const double upper = sorted[std::min(below + 1, sorted.size() - 1)];
  return sorted[below] + (position - static_cast<double>(below)) * (upper - sorted[below]);
}

double
ReachBySorting(std::vector<double> values, double level, std::size_t count)
{
  std::transform(values.begin(), values.end(), values.begin(), [level](double u) { return std::abs(u - level); });
  std::sort(values.begin(), values.end());
  return values[std::min(count, values.size()) - 1];
}
} // namespace

TEST(SensorNoiseIntensityIndex, QuantileEqualsThatOfSortedValues)
{
  for (const std::size_t size : { 1, 2, 3, 10, 1001 })
  {
    const auto sorted = RandomScene(Kind::Uniform, size, size).Sorted();
    for (const double q : { 0.0, 0.01, 0.25, 0.5, 0.99, 1.0 })
    {
      std::vector<double> values(sorted.rbegin(), sorted.rend());
      ASSERT_EQ(Quantile(values, q), QuantileOfSorted(sorted, q)) << size << ' ' << q;
    }
  }
  std::vector<double> none;
  EXPECT_THROW(Quantile(none, 0.5), std::invalid_argument);
}

TEST(SensorNoiseIntensityIndex, QuantileDnEqualsThatOfSortedPixels)
{
  for (const Kind kind : { Kind::Uniform, Kind::Clustered, Kind::Tied, Kind::Lattice })
  {
    for (const std::size_t size : { 1, 2, 50, 5000 })
    {
      const Scene scene = RandomScene(kind, size, size);
      const auto  sorted = scene.Sorted();
      ASSERT_EQ(scene.Index().Count(), sorted.size());
      for (const double q : { 0.0, 0.01, 0.3, 0.5, 0.97, 0.99, 1.0 })
      {
        ASSERT_EQ(scene.Index().QuantileDn(q), QuantileOfSorted(sorted, q)) << size << ' ' << q;
      }
    }
  }
}

TEST(SensorNoiseIntensityIndex, ReachEqualsThatOfSortedDistances)
{
  for (const Kind kind : { Kind::Uniform, Kind::Clustered, Kind::Tied, Kind::Lattice })
  {
    for (const std::size_t size : { 1, 2, 60, 5000 })
    {
      const Scene          scene = RandomScene(kind, size, size);
      const auto           sorted = scene.Sorted();
      const IntensityIndex index = scene.Index();
      for (const double q : { 0.0, 0.01, 0.5, 0.99, 1.0 })
      {
        const double level = QuantileOfSorted(sorted, q);
        for (const std::size_t count : { 1, 25, 1000, 100000 })
        {
          ASSERT_EQ(index.ReachDn(level, count), ReachBySorting(sorted, level, count))
            << size << ' ' << q << ' ' << count;
        }
      }
    }
  }
}

TEST(SensorNoiseIntensityIndex, ReachHoldsThePixelsOnTheEdgesOfItsCells)
{
  // Three values two cells apart: the farthest lies exactly at the limit of the cells that are searched.
  for (const double scale : { 1.0, 0.1, 1.0 / 3.0, 7e-5, 1e9 })
  {
    for (const double highest : { 65536.0, 65535.0, 65534.0 })
    {
      const std::vector<double>       mean{ 0.0, (highest - 2.0) * scale, highest * scale };
      const std::vector<std::uint8_t> mask(3, 1);
      const IntensityIndex            index(mean.data(), mask.data(), 3);
      ASSERT_EQ(index.ReachDn(mean[1], 2), mean[2] - mean[1]) << scale;
      ASSERT_EQ(index.ReachDn(mean[2], 2), mean[2] - mean[1]) << scale;
      ASSERT_EQ(index.ReachDn(mean[0], 3), mean[2]) << scale;
    }
  }
}

TEST(SensorNoiseIntensityIndex, ConstantPixelsHaveOneQuantileAndNoReach)
{
  const Scene          scene(std::vector<double>(500, 321.5));
  const IntensityIndex index = scene.Index();
  EXPECT_EQ(index.QuantileDn(0.01), 321.5);
  EXPECT_EQ(index.QuantileDn(1.0), 321.5);
  EXPECT_EQ(index.ReachDn(321.5, 25), 0.0);
  EXPECT_LT(IntensityIndex::Bins(index, 256).Of(321.5), 256u);
}

TEST(SensorNoiseIntensityIndex, BinsHoldNearlyTheSameNumberOfPixels)
{
  constexpr std::size_t      count = 16;
  std::mt19937_64            random(11);
  std::normal_distribution<> normal(0.0, 1.0);
  std::vector<double>        values(40000);
  std::generate(values.begin(), values.end(), [&] { return std::exp(normal(random)); }); // skewed
  const Scene                scene(std::move(values));
  const IntensityIndex       index = scene.Index();
  const IntensityIndex::Bins bins(index, count);
  std::vector<std::size_t>   counts(count, 0);
  std::size_t                last = 0;
  for (const double value : scene.Sorted())
  {
    const std::size_t bin = bins.Of(value);
    ASSERT_GE(bin, last); // bins ascend with the mean
    last = bin;
    ++counts[bin];
  }
  // A bin's ends move by one cell each: the densest cell of exp(normal) over [0, 65] has 0.65 * 1e-3 of the pixels.
  const auto expected = static_cast<double>(index.Count()) / count;
  for (const std::size_t own : counts)
  {
    EXPECT_NEAR(static_cast<double>(own), expected, 2.0 * 1e-3 * static_cast<double>(index.Count()));
  }
}

TEST(SensorNoiseIntensityIndex, EmptyMaskHasNoQuantile)
{
  const std::vector<double>       mean(10, 5.0);
  const std::vector<std::uint8_t> mask(10, 0);
  const IntensityIndex            index(mean.data(), mask.data(), mean.size());
  EXPECT_EQ(index.Count(), 0u);
  EXPECT_THROW(index.QuantileDn(0.5), std::invalid_argument);
}
