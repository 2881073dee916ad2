// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t   Width = 120;
constexpr std::size_t   Height = 100;
constexpr FrameGeometry Geometry{ Width, Height, 1 };
constexpr double        OffsetDn = 100.0;

using Level = std::function<double(std::size_t x, std::size_t y)>;

/** Returns mean levels with a noise of 0.4 DN. */
std::vector<double>
MeanOf(const Level & level)
{
  std::mt19937               random(3);
  std::normal_distribution<> noise(0.0, 0.4);
  std::vector<double>        mean;
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    mean.push_back(level(p % Width, p / Width) + noise(random));
  }
  return mean;
}

MaskedBorder
BorderOf(const Level & level)
{
  return FindMaskedBorder(MeanOf(level), std::vector<std::uint8_t>(Width * Height, 1), Geometry);
}

double
Waves(std::size_t x, std::size_t y)
{
  return OffsetDn + 800.0 + 700.0 * std::sin(0.13 * static_cast<double>(x)) * std::cos(0.09 * static_cast<double>(y));
}

double
BlackSky(std::size_t x, std::size_t y)
{
  const double dx = static_cast<double>(x) - 60.0;
  const double dy = static_cast<double>(y) - 50.0;
  return OffsetDn + 2000.0 * std::exp(-(dx * dx + dy * dy) / 200.0);
}

double
Ramp(std::size_t x, std::size_t)
{
  return OffsetDn + 20.0 + 10.0 * static_cast<double>(x);
}
} // namespace

TEST(SensorNoiseMaskedBorder, FindsBlackColumnsAndRowsOfEverySide)
{
  for (const Level & scene : { Level(Waves), Level(BlackSky), Level(Ramp) })
  {
    const MaskedBorder border = BorderOf([&](std::size_t x, std::size_t y) {
      return x < 8 || x >= Width - 5 || y < 3 || y >= Height - 12 ? OffsetDn - 5.0 : scene(x, y);
    });
    EXPECT_EQ(border.left, 8u);
    EXPECT_EQ(border.right, 5u);
    EXPECT_EQ(border.top, 3u);
    EXPECT_EQ(border.bottom, 12u);
    ASSERT_EQ(border.strips.size(), 4u);
    EXPECT_NEAR(border.strips[0].levelDn, OffsetDn - 5.0, 0.3);
    EXPECT_EQ(border.Pixels(Geometry), Width * Height - (Width - 13) * (Height - 15));
    EXPECT_TRUE(border.Holds(7, 50, Geometry));
    EXPECT_FALSE(border.Holds(8, 50, Geometry));
    EXPECT_TRUE(border.Holds(50, Height - 12, Geometry));
    EXPECT_FALSE(border.Holds(50, Height - 13, Geometry));
  }
}

TEST(SensorNoiseMaskedBorder, FindsRowsOfATestLevel)
{
  const MaskedBorder border = BorderOf([](std::size_t x, std::size_t y) { return y >= 98 ? 600.0 : Waves(x, y); });
  EXPECT_EQ(border.bottom, 2u);
  EXPECT_EQ(border.strips.size(), 1u);
}

// Light below a mask decays from its edge, and no line has the structure of the scene.
TEST(SensorNoiseMaskedBorder, FindsMasksWithASoftEdge)
{
  for (const double widthPixels : { 0.7, 2.0, 6.0 })
  {
    const auto         leak = [&](double depth) { return OffsetDn - 5.0 + 800.0 * std::exp(-depth / widthPixels); };
    const MaskedBorder border = BorderOf([&](std::size_t x, std::size_t y) {
      return x < 14            ? leak(13.0 - static_cast<double>(x))
             : y >= Height - 6 ? leak(static_cast<double>(y) - (Height - 6.0))
                               : Waves(x, y);
    });
    EXPECT_EQ(border.left, 14u);
    EXPECT_EQ(border.bottom, 6u);
    EXPECT_EQ(border.strips.size(), 2u);
  }
}

TEST(SensorNoiseMaskedBorder, FindsNoneInScenes)
{
  EXPECT_TRUE(BorderOf(Waves).strips.empty());
  EXPECT_TRUE(BorderOf(BlackSky).strips.empty());
  EXPECT_TRUE(BorderOf(Ramp).strips.empty());
  EXPECT_TRUE(BorderOf([](std::size_t, std::size_t) { return 700.0; }).strips.empty());
  // Uniform fields of a test chart, one of them in the corner.
  EXPECT_TRUE(BorderOf([](std::size_t x, std::size_t y) {
                return OffsetDn + 100.0 * static_cast<double>((x / 20 * 7 + y / 20 * 3) % 11);
              }).strips.empty());
}

// A black bar along the border, blurred by 0.5 pixels, is part of the scene.
TEST(SensorNoiseMaskedBorder, FindsNoneInABlurredBar)
{
  const MaskedBorder border = BorderOf([](std::size_t x, std::size_t y) {
    const double inside = 0.5 * (1.0 + std::erf((static_cast<double>(x) + 0.5 - 8.0) / (0.5 * std::sqrt(2.0))));
    return OffsetDn + inside * (Waves(x, y) - OffsetDn);
  });
  EXPECT_TRUE(border.strips.empty());
}

TEST(SensorNoiseMaskedBorder, FindsNoneWherePixelsAreInvalid)
{
  const std::vector<double> mean = MeanOf([](std::size_t x, std::size_t y) { return x < 8 ? 95.0 : Waves(x, y); });
  std::vector<std::uint8_t> valid(Width * Height, 1);
  for (std::size_t p = 0; p < valid.size(); ++p)
  {
    valid[p] = p % Width < 8 ? 0 : 1;
  }
  EXPECT_TRUE(FindMaskedBorder(mean, valid, Geometry).strips.empty());
}
