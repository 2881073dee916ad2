// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ColourCovariance.h"
#include "base/Eigen.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Side = 32;
constexpr std::size_t Tiles = 16;
constexpr std::size_t Frames = 20;
constexpr double      Variance = 4.0; // every pixel has it, at the signal 1 [DN^2]

/** Samples of the four planes of mosaics whose white noise is spread by the weight \a spread to each of the four
 * neighbours, and which have the noise \a ofRows in common along each row [DN]. */
std::array<SampledNoise, 4>
SampleOfPlanes(double spread, double ofRows)
{
  constexpr std::size_t       width = 2 * Side;
  std::array<SampledNoise, 4> planes;
  for (SampledNoise & plane : planes)
  {
    plane.tiles.side = Side;
    plane.tiles.frames = Frames;
    plane.tiles.origins.resize(Tiles);
    plane.values.resize(plane.tiles.Values());
    plane.weight.assign(Tiles * Side * Side, static_cast<float>(1.0 / Variance));
    plane.signal.assign(Tiles * Side * Side, 1.0F);
    plane.basis = Eigen::MatrixXd(Frames, 0); // nothing was projected out
  }
  std::mt19937_64                  random(3);
  std::normal_distribution<double> normal;
  for (std::size_t frame = 0; frame < Tiles * Frames; ++frame)
  {
    Eigen::ArrayXXd white(width + 2, width + 2);
    white = white.unaryExpr([&](double) { return std::sqrt(Variance) * normal(random); }).eval();
    const Eigen::ArrayXXd filtered = (1.0 - 4.0 * spread) * white.block(1, 1, width, width) +
                                     spread * (white.block(0, 1, width, width) + white.block(2, 1, width, width) +
                                               white.block(1, 0, width, width) + white.block(1, 2, width, width));
    for (std::size_t y = 0; y < width; ++y)
    {
      const double common = ofRows * normal(random);
      for (std::size_t x = 0; x < width; ++x)
      {
        SampledNoise &    plane = planes[y % 2 * 2 + x % 2];
        const std::size_t place = plane.tiles.PlaceOf(frame / Frames, frame % Frames) + y / 2 * Side + x / 2;
        const double      value = filtered(static_cast<Eigen::Index>(y), static_cast<Eigen::Index>(x)) + common;
        plane.values[place] = static_cast<float>(value);
      }
    }
  }
  return planes;
}

std::array<NeighbourCovariance, 4>
Measure(const std::array<SampledNoise, 4> & noise)
{
  return MeasureNeighbourCovariance(
    { { &noise[0], &noise[1], &noise[2], &noise[3] }, { { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } } } });
}
} // namespace

// A kernel of the weights 1 - 4 e and e has the covariance 2 e (1 - 4 e) with each of the four neighbours. With each of
// the four at the corners it is 2 e^2, in units of the white variance.
TEST(SensorNoiseColourCovariance, SpreadHasTheCovarianceOfItsKernel)
{
  for (const double ofRows : { 0.0, 1.0 }) // noise of rows is no covariance of neighbours
  {
    for (const double spread : { 0.0, 0.02, -0.03 })
    {
      const double expected = Variance * (8.0 * spread * (1.0 - 4.0 * spread) + 8.0 * spread * spread);
      for (const NeighbourCovariance & own : Measure(SampleOfPlanes(spread, ofRows)))
      {
        // 16 means of products over some 310,000 pairs of pixels, whose noise has two parts
        EXPECT_LT(own.slope.standardError, 2.0 * 4.0 * (1.3 * Variance + 2.0 * ofRows) / std::sqrt(310e3));
        EXPECT_NEAR(own.slope.value, expected, 4.0 * own.slope.standardError);
        EXPECT_NEAR(own.typical, expected, 4.0 * 1.25 * own.slope.standardError);
      }
    }
  }
}

TEST(SensorNoiseColourCovariance, UnlikeSamplesAreNotCompared)
{
  std::array<SampledNoise, 4> noise = SampleOfPlanes(0.02, 0.0);
  noise[2].tiles.frames = Frames - 1;
  for (const NeighbourCovariance & own : Measure(noise))
  {
    EXPECT_FALSE(own.slope.Exceeds(0.0, 1.0));
  }
}
