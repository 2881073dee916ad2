// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/LevelSums.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 200;
constexpr std::size_t Height = 120;

template <typename TPixel>
SingleFrame<TPixel>
FrameOf(const std::vector<TPixel> & pixels)
{
  return { pixels.data(), PixelLayout::OfFrames({ Width, Height, 1 }), Height, nullptr, 0.0, 1.0 };
}

/** Returns all positions of a frame whose pixels are function(x, y). */
template <typename TFunction>
BandTile
TileOf(TFunction function)
{
  std::vector<double> pixels(Width * Height);
  for (std::size_t p = 0; p < pixels.size(); ++p)
  {
    pixels[p] = function(static_cast<double>(p % Width), static_cast<double>(p / Width));
  }
  BandTile tile;
  tile.Compute(FrameOf(pixels),
               { 0, 0, SingleFrame<double>::PositionsAlong(Width), SingleFrame<double>::PositionsAlong(Height) });
  return tile;
}

double
MeanOf(const std::vector<float> & values)
{
  double sum = 0.0;
  for (const float value : values)
  {
    sum += static_cast<double>(value);
  }
  return sum / static_cast<double>(values.size());
}
} // namespace

TEST(SensorNoiseBandTile, WeightsAreOrthonormal)
{
  for (std::size_t shift = 0; shift < Wavelet::Taps; shift += 2)
  {
    double lowLow = 0.0;
    double highHigh = 0.0;
    double lowHigh = 0.0;
    double highLow = 0.0;
    for (std::size_t k = 0; k + shift < Wavelet::Taps; ++k)
    {
      lowLow += static_cast<double>(Wavelet::low[k]) * static_cast<double>(Wavelet::low[k + shift]);
      highHigh += static_cast<double>(Wavelet::high[k]) * static_cast<double>(Wavelet::high[k + shift]);
      lowHigh += static_cast<double>(Wavelet::low[k]) * static_cast<double>(Wavelet::high[k + shift]);
      highLow += static_cast<double>(Wavelet::high[k]) * static_cast<double>(Wavelet::low[k + shift]);
    }
    const double expected = shift == 0 ? 1.0 : 0.0;
    EXPECT_NEAR(lowLow, expected, 1e-6);
    EXPECT_NEAR(highHigh, expected, 1e-6);
    EXPECT_NEAR(lowHigh, 0.0, 1e-6);
    EXPECT_NEAR(highLow, 0.0, 1e-6);
  }
}

TEST(SensorNoiseBandTile, ARampHasItsLevelAndNoDetailsAndNoRoughness)
{
  const BandTile    tile = TileOf([](double x, double y) { return 3.0 * x + 2.0 * y + 7.0; });
  const std::size_t across = SingleFrame<double>::PositionsAlong(Width);
  for (std::size_t i = 0; i < tile.Positions(); i += 97)
  {
    // The squared weights of a diagonal detail have their centre 3.836 pixels from its first pixel, along both axes.
    const double x = 2.0 * static_cast<double>(i % across + WaveletWindow::Detail) + 3.836;
    const double y = 2.0 * static_cast<double>(i / across + WaveletWindow::Detail) + 3.836;
    ASSERT_NEAR(tile.level[i], 3.0 * x + 2.0 * y + 7.0, 0.1); // the two centres differ by 0.02 pixels
    ASSERT_NEAR(tile.roughness[i], 0.0, 1e-3);                // rounding of floats, of levels to 800
    ASSERT_NEAR(tile.diagonal[i], 0.0, 1e-6);
  }
}

/** A detail has the noise of its pixels, with its squared weights. */
TEST(SensorNoiseBandTile, AParabolaHasTheLevelOfTheNoiseOfItsDetails)
{
  const auto parabola = [](double x, double y) {
    return 0.02 * (x - 90.0) * (x - 90.0) + 0.03 * (y - 50.0) * (y - 50.0);
  };
  const BandTile    tile = TileOf(parabola);
  const std::size_t across = SingleFrame<double>::PositionsAlong(Width);
  for (std::size_t i = 0; i < tile.Positions(); i += 97)
  {
    double level = 0.0;
    for (std::size_t k = 0; k < Wavelet::Taps * Wavelet::Taps; ++k)
    {
      const auto high = [&](std::size_t tap) { return static_cast<double>(Wavelet::high[tap]); };
      const auto at = [&](std::size_t position, std::size_t tap) {
        return static_cast<double>(2 * (position + WaveletWindow::Detail) + tap);
      };
      const double root = high(k % Wavelet::Taps) * high(k / Wavelet::Taps);
      level += root * root * parabola(at(i % across, k % Wavelet::Taps), at(i / across, k / Wavelet::Taps));
    }
    ASSERT_NEAR(tile.level[i], level, 0.2); // the centres differ by 0.02 pixels, along slopes of up to 4.4 and 4.2
  }
}

TEST(SensorNoiseBandTile, ParabolasHaveNoDiagonalDetail)
{
  const BandTile tile =
    TileOf([](double x, double y) { return 1e-3 * (x * x - 5.0 * x * y + 2.0 * y * y + x * x * y); });
  for (std::size_t i = 0; i < tile.Positions(); i += 31)
  {
    ASSERT_NEAR(tile.diagonal[i], 0.0, 1e-5);
  }
}

TEST(SensorNoiseBandTile, EdgesAlongRowsAndColumnsHaveNoDiagonalDetail)
{
  const BandTile rows = TileOf([](double, double y) { return y < 60.0 ? 1.0 : 5.0; });
  const BandTile columns = TileOf([](double x, double) { return x < 100.0 ? 1.0 : 5.0; });
  EXPECT_NEAR(MeanOf(rows.diagonal), 0.0, 1e-9);
  EXPECT_NEAR(MeanOf(columns.diagonal), 0.0, 1e-9);
  EXPECT_NEAR(MeanOf(rows.horizontal), 0.0, 1e-9);
  EXPECT_NEAR(MeanOf(columns.vertical), 0.0, 1e-9);
  EXPECT_GT(MeanOf(rows.vertical), 1e-3);
  EXPECT_GT(MeanOf(columns.horizontal), 1e-3);
}

TEST(SensorNoiseBandTile, WhiteNoiseHasItsVarianceInEveryBand)
{
  std::mt19937_64                  random(5);
  std::normal_distribution<double> normal(0.0, 2.0);
  const BandTile                   tile = TileOf([&](double, double) { return 50.0 + normal(random); });
  // n independent squares have a relative standard error of sqrt(2 / n); squares of windows are correlated, but there
  // are as many coefficients. Five errors.
  const double tolerance = 4.0 * 5.0 * std::sqrt(2.0 / static_cast<double>(tile.Positions()));
  EXPECT_NEAR(MeanOf(tile.diagonal), 4.0, tolerance);
  EXPECT_NEAR(MeanOf(tile.horizontal), 4.0, tolerance);
  EXPECT_NEAR(MeanOf(tile.vertical), 4.0, tolerance);
  EXPECT_NEAR(MeanOf(tile.roughness), 4.0, tolerance);
}

TEST(SensorNoiseBandTile, PartsOfATileHaveItsBits)
{
  std::mt19937_64                             random(6);
  std::uniform_int_distribution<unsigned int> uniform(0, 4000);
  std::vector<unsigned short>                 pixels(Width * Height);
  for (unsigned short & pixel : pixels)
  {
    pixel = static_cast<unsigned short>(uniform(random));
  }
  const std::size_t across = SingleFrame<unsigned short>::PositionsAlong(Width);
  BandTile          whole;
  BandTile          part;
  whole.Compute(FrameOf(pixels), { 0, 0, across, SingleFrame<unsigned short>::PositionsAlong(Height) });
  part.Compute(FrameOf(pixels), { 13, 5, 20, 10 });
  for (std::size_t i = 0; i < part.Positions(); ++i)
  {
    const std::size_t at = (5 + i / 20) * across + 13 + i % 20;
    ASSERT_EQ(part.level[i], whole.level[at]);
    ASSERT_EQ(part.roughness[i], whole.roughness[at]);
    ASSERT_EQ(part.diagonal[i], whole.diagonal[at]);
    ASSERT_EQ(part.horizontal[i], whole.horizontal[at]);
    ASSERT_EQ(part.vertical[i], whole.vertical[at]);
  }
}

TEST(SensorNoiseBandTile, OnlyWindowsOfAPixelThatIsNotFiniteAreLeftOut)
{
  std::vector<float> pixels(Width * Height, 1.0F);
  pixels[60 * Width + 100] = std::nanf("");
  const std::size_t across = SingleFrame<float>::PositionsAlong(Width);
  BandTile          tile;
  tile.Compute(FrameOf(pixels), { 0, 0, across, SingleFrame<float>::PositionsAlong(Height) });
  std::size_t missing = 0;
  for (const float roughness : tile.roughness)
  {
    missing += std::isnan(roughness) ? 1 : 0;
  }
  // 3 coefficients along an axis hold the pixel, and the windows of a position reach over 10.
  EXPECT_EQ(missing, 12U * 12U);
}
