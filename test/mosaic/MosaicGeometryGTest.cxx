// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Planes that are taken from frames of a mosaic, and put or joined into them.
#include "mosaic/MosaicGeometry.h"

#include "sensornoise/FrameGeometry.h"
#include "helpers/StackTestHelper.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using Pixel = unsigned short;

TEST(MosaicGeometry, SplitAndPutAreInverse)
{
  const MosaicGeometry geometry{ { 10, 6, 1 }, BayerPattern::GRBG };
  std::vector<int>     frame(60);
  for (std::size_t p = 0; p < frame.size(); ++p)
  {
    frame[p] = static_cast<int>(p);
  }
  std::vector<int> again(60, -1);
  for (const BayerPlane plane : BayerPlanes)
  {
    const std::vector<int> ofPlane = geometry.Take(frame, plane);
    EXPECT_EQ(ofPlane.size(), 15U);
    geometry.Put(ofPlane, plane, again.data());
  }
  EXPECT_EQ(again, frame);
  EXPECT_TRUE(geometry.Take(std::vector<int>(), BayerPlane::R).empty());
}

TEST(MosaicGeometry, JoinIsPutOfEachPlane)
{
  for (const char * const name : { "RGGB", "GRBG", "GBRG", "BGGR" })
  {
    const MosaicGeometry geometry{ { 11, 7, 1 }, BayerPatternOf(name) }; // the last column and row are in none
    std::array<std::vector<int>, 4> ofPlanes;
    std::vector<int>                expected(77, -1);
    for (std::size_t k = 0; k < ofPlanes.size(); ++k)
    {
      ofPlanes[k].resize(k == 2 ? 0 : 15); // one plane has no map
      std::iota(ofPlanes[k].begin(), ofPlanes[k].end(), static_cast<int>(100 * k));
      geometry.Put(ofPlanes[k], BayerPlanes.at(k), expected.data());
    }
    EXPECT_EQ(geometry.Join(ofPlanes, -1, Threads(3)), expected) << name;
  }
}

TEST(MosaicGeometry, FramesAreTakenAsEachOfThem)
{
  constexpr std::size_t count = 3;
  for (const char * const name : { "RGGB", "GRBG", "GBRG", "BGGR" })
  {
    const MosaicGeometry geometry{ { 11, 7, 1 }, BayerPatternOf(name) }; // the last column and row are in no plane
    const std::size_t    pixels = geometry.Plane().Pixels();
    std::vector<Pixel>   frames(count * geometry.frame.Pixels());
    std::iota(frames.begin(), frames.end(), Pixel{ 0 });
    std::array<std::vector<Pixel>, 4> taken;
    std::array<Pixel *, 4>            to{};
    for (std::size_t k = 0; k < to.size(); ++k)
    {
      taken[k].resize(count * pixels);
      to[k] = taken[k].data();
    }
    geometry.TakeFrames(frames.data(), count, to, SerialFor);
    for (std::size_t k = 0; k < to.size(); ++k)
    {
      std::vector<Pixel> expected;
      for (std::size_t t = 0; t < count; ++t)
      {
        const auto begin = frames.begin() + static_cast<std::ptrdiff_t>(t * geometry.frame.Pixels());
        const auto end = begin + static_cast<std::ptrdiff_t>(geometry.frame.Pixels());
        const auto plane = geometry.Take(std::vector<Pixel>(begin, end), BayerPlanes[k]);
        expected.insert(expected.end(), plane.begin(), plane.end());
      }
      EXPECT_EQ(taken[k], expected) << name << ", plane " << k;
    }
  }
}
