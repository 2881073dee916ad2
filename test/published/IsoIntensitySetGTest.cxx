// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"
#include "base/NothingToMeasure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Frames = 100;

/** Maps of a scene, with a mask of 1. */
struct Scene
{
  std::vector<double>       mean;
  std::vector<double>       variance;
  std::vector<std::uint8_t> mask;

  Scene(std::vector<double> means, double varianceDn2)
    : mean(std::move(means))
    , variance(mean.size(), varianceDn2)
    , mask(mean.size(), 1)
  {}
  IsoIntensitySet
  Find(double quantile) const
  {
    return IsoIntensitySetFinder(mean.data(), variance.data(), mask.data(), mean.size(), Frames).Find(quantile);
  }
};

/** Returns equidistant means: 100, 100 + spacing, ... */
std::vector<double>
Ladder(std::size_t pixels, double spacing)
{
  std::vector<double> mean(pixels);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    mean[p] = 100.0 + spacing * static_cast<double>(p);
  }
  return mean;
}

double
SumOfWeights(const IsoIntensitySet & set)
{
  double sum = 0.0;
  for (const double weight : set.weights)
  {
    sum += weight;
  }
  return sum;
}

/** Expects that the set has exactly the pixels of the mask within 3 sd of its level, with Gaussian weights. */
void
ExpectGaussianWeightsWithinThreeSd(const IsoIntensitySet & set, const Scene & scene, double sdDn)
{
  std::vector<std::uint32_t> pixels;
  std::vector<double>        weights;
  double                     total = 0.0;
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    const double d = (scene.mean[p] - set.levelDn) / sdDn;
    if (scene.mask[p] != 0 && std::abs(d) <= 3.0)
    {
      pixels.push_back(static_cast<std::uint32_t>(p));
      weights.push_back(std::exp(-0.5 * d * d));
      total += weights.back();
    }
  }
  ASSERT_EQ(set.pixels, pixels);
  ASSERT_EQ(set.weights.size(), weights.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    ASSERT_NEAR(set.weights[i], weights[i] / total, 1e-14);
    squares += weights[i] * weights[i] / (total * total);
  }
  EXPECT_NEAR(SumOfWeights(set), 1.0, 1e-12);
  EXPECT_NEAR(set.EffectivePixels(), 1.0 / squares, 1e-9 / squares);
}
} // namespace

TEST(SensorNoiseIsoIntensitySet, WeightsFollowRemarkOne)
{
  std::mt19937_64                  random(1);
  std::uniform_real_distribution<> uniform(200.0, 300.0);
  std::vector<double>              mean(20000);
  std::generate(mean.begin(), mean.end(), [&] { return uniform(random); });
  Scene scene(std::move(mean), 36.0);
  for (std::size_t p = 0; p < scene.mask.size(); p += 5)
  {
    scene.mask[p] = 0;
  }
  for (const double quantile : { 0.01, 0.4, 0.99 })
  {
    const IsoIntensitySet set = scene.Find(quantile);
    EXPECT_EQ(set.wideningSteps, 0u);
    EXPECT_EQ(set.quantile, quantile);
    // Uniform order statistic: sd = 100 DN sqrt(q (1 - q) / 16,000), at most 0.4 DN.
    EXPECT_NEAR(set.levelDn, 200.0 + 100.0 * quantile, 4.0 * 0.4);
    EXPECT_EQ(set.temporalVarianceDn2, 36.0);
    EXPECT_DOUBLE_EQ(set.levelSdDn, 0.6); // sqrt(36 / 100 frames)
    ExpectGaussianWeightsWithinThreeSd(set, scene, set.levelSdDn);
  }
}

TEST(SensorNoiseIsoIntensitySet, VarianceIsTheMedianOfThePixelsNearTheLevel)
{
  Scene scene(Ladder(1000, 0.01), 4.0);
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    scene.variance[p] = p < 500 ? 1.0 : 9.0;
  }
  scene.variance[10] = 1e6; // one blinking pixel
  EXPECT_EQ(scene.Find(0.01).temporalVarianceDn2, 1.0);
  EXPECT_EQ(scene.Find(0.99).temporalVarianceDn2, 9.0);
}

TEST(SensorNoiseIsoIntensitySet, EqualMeansHaveEqualWeights)
{
  const IsoIntensitySet set = Scene(std::vector<double>(64, 50.0), 1.0).Find(0.99);
  EXPECT_EQ(set.pixels.size(), 64u);
  EXPECT_DOUBLE_EQ(set.EffectivePixels(), 64.0);
  EXPECT_DOUBLE_EQ(set.weights.front(), 1.0 / 64.0);
}

TEST(SensorNoiseIsoIntensitySet, QuantileMovesInwardsWhereTheSetIsTooSmall)
{
  // The sd of the mean is 0.1 DN. At both ends 2.5 % of the pixels are 10 DN apart; the middle is dense.
  auto mean = Ladder(1000, 0.01);
  for (std::size_t p = 0; p < 25; ++p)
  {
    mean[p] = -1000.0 + 10.0 * static_cast<double>(p);
    mean[999 - p] = 2000.0 - 10.0 * static_cast<double>(p);
  }
  const Scene           scene(std::move(mean), 1.0);
  const IsoIntensitySet dark = scene.Find(0.01);
  EXPECT_EQ(dark.wideningSteps, 2u); // the levels at 1 % and 2 % are sparse, at 3 % not
  EXPECT_DOUBLE_EQ(dark.quantile, 0.03);
  ExpectGaussianWeightsWithinThreeSd(dark, scene, dark.levelSdDn);
  const IsoIntensitySet bright = scene.Find(0.99);
  EXPECT_EQ(bright.wideningSteps, 2u);
  EXPECT_DOUBLE_EQ(bright.quantile, 0.97);
  ExpectGaussianWeightsWithinThreeSd(bright, scene, bright.levelSdDn);
}

TEST(SensorNoiseIsoIntensitySet, BandWidensByFactorsOfTwoWhereNoQuantileServes)
{
  // The sd of the mean is 0.1 DN, with one pixel per DN: within 3 sd 2^k are 2 floor(0.3 2^k) + 1 pixels, at least 30
  // from k = 6 on.
  const Scene           scene(Ladder(1000, 1.0), 1.0);
  const IsoIntensitySet set = scene.Find(0.01);
  EXPECT_EQ(set.wideningSteps, 4u + 6u);
  EXPECT_DOUBLE_EQ(set.quantile, 0.05);
  EXPECT_EQ(set.pixels.size(), 2u * 19u + 1u);
  ExpectGaussianWeightsWithinThreeSd(set, scene, 64.0 * set.levelSdDn);
}

TEST(SensorNoiseIsoIntensitySet, TooFewPixelsAreRefusedWithTheirNumber)
{
  Scene scene(std::vector<double>(100, 50.0), 1.0);
  std::fill(scene.mask.begin() + 30, scene.mask.end(), std::uint8_t{ 0 });
  EXPECT_NO_THROW(scene.Find(0.5));
  scene.mask[29] = 0;
  try
  {
    scene.Find(0.5);
    FAIL() << "nothing was thrown";
  }
  catch (const NothingToMeasure & error)
  {
    EXPECT_NE(std::string(error.what()).find("only 29 pixels"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("at least 30"), std::string::npos) << error.what();
  }
}

TEST(SensorNoiseIsoIntensitySet, SceneWithoutEvenAreasIsRefused)
{
  // The sd of the mean is 1e-6 DN, with one pixel per DN: the widest band, 3e-6 * 2^12 = 0.012 DN, has one pixel.
  try
  {
    Scene(Ladder(101, 1.0), 1e-10).Find(0.01);
    FAIL() << "nothing was thrown";
  }
  catch (const NothingToMeasure & error)
  {
    EXPECT_NE(std::string(error.what()).find("found 1 pixels"), std::string::npos) << error.what();
  }
}

TEST(SensorNoiseIsoIntensitySet, RowSetHoldsThePixelsWithinSixSdEquallyWeighted)
{
  const Scene                 scene(Ladder(2000, 0.01), 1.0); // sd of the mean 0.1 DN
  const IsoIntensitySetFinder finder(
    scene.mean.data(), scene.variance.data(), scene.mask.data(), scene.mean.size(), Frames);
  const IsoIntensitySet bright = finder.Find(0.9);
  const IsoIntensitySet rowSet = finder.FindRowSet(bright);
  // 6 sd are 0.6 DN: 60 pixels on each side of the level, apart from pixels at the limit.
  EXPECT_NEAR(static_cast<double>(rowSet.pixels.size()), 121.0, 2.0);
  for (std::size_t i = 0; i < rowSet.pixels.size(); ++i)
  {
    EXPECT_LE(std::abs(scene.mean[rowSet.pixels[i]] - bright.levelDn), 0.6);
    EXPECT_EQ(rowSet.weights[i], rowSet.weights[0]);
  }
  EXPECT_NEAR(SumOfWeights(rowSet), 1.0, 1e-12);
}
