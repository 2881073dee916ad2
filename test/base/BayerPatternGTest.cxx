// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameGeometry.h"

#include <array>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

using sensornoise::BayerPattern;
using sensornoise::BayerPlane;

namespace
{
constexpr std::array<BayerPattern, 4> Patterns{
  { BayerPattern::RGGB, BayerPattern::GRBG, BayerPattern::GBRG, BayerPattern::BGGR }
};
} // namespace

TEST(BayerPattern, NameSpellsTheFirstPixels)
{
  for (const BayerPattern pattern : Patterns)
  {
    std::string spelt = "....";
    for (const BayerPlane plane : sensornoise::BayerPlanes)
    {
      const auto corner = sensornoise::CornerOf(pattern, plane);
      spelt.at(2 * corner[1] + corner[0]) = *sensornoise::NameOf(plane);
    }
    EXPECT_EQ(spelt, sensornoise::NameOf(pattern));
    EXPECT_EQ(sensornoise::BayerPatternOf(spelt), pattern);
  }
}

TEST(BayerPattern, FirstGreenIsInTheRowsOfRed)
{
  for (const BayerPattern pattern : Patterns)
  {
    EXPECT_EQ(CornerOf(pattern, BayerPlane::G1)[1], CornerOf(pattern, BayerPlane::R)[1]);
    EXPECT_EQ(CornerOf(pattern, BayerPlane::G2)[1], CornerOf(pattern, BayerPlane::B)[1]);
  }
}

TEST(BayerPattern, CutFindsEachColourWhereItWas)
{
  for (const BayerPattern pattern : Patterns)
  {
    for (std::size_t columns = 0; columns < 5; ++columns)
    {
      for (std::size_t rows = 0; rows < 5; ++rows)
      {
        const BayerPattern cut = sensornoise::CutPattern(pattern, columns, rows);
        for (const BayerPlane plane : sensornoise::BayerPlanes)
        {
          const auto before = CornerOf(pattern, plane);
          const auto after = CornerOf(cut, plane);
          EXPECT_EQ((after[0] + columns) % 2, before[0]);
          EXPECT_EQ((after[1] + rows) % 2, before[1]);
        }
      }
    }
  }
}

TEST(BayerPattern, UnknownNamesAreRefused)
{
  EXPECT_THROW(sensornoise::BayerPatternOf("rggb"), std::invalid_argument);
  EXPECT_THROW(sensornoise::BayerPlaneOf("G"), std::invalid_argument);
  for (const BayerPlane plane : sensornoise::BayerPlanes)
  {
    EXPECT_EQ(sensornoise::BayerPlaneOf(sensornoise::NameOf(plane)), plane);
  }
}
