// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/PixelLayout.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 93; // width of a plane: longer than the SIMD vectors, and not a multiple of them
constexpr std::size_t Height = 5;
constexpr std::size_t Columns = 2 * Width + 1; // columns of the mosaic
constexpr std::size_t Frames = 3;

/** Every second pixel of every second row. */
const PixelLayout OfPlane{ Columns + 1, 2, 2 * Columns, 2 * Columns * Height, Width };

std::vector<unsigned short>
Mosaics()
{
  std::vector<unsigned short> mosaics(Frames * OfPlane.frame);
  std::iota(mosaics.begin(), mosaics.end(), static_cast<unsigned short>(0));
  return mosaics;
}
} // namespace

TEST(SensorNoisePixelLayout, PixelsAreCopiedFromWhereTheyStand)
{
  const std::vector<unsigned short> mosaics = Mosaics();
  for (const auto & [begin, end] : { std::pair<std::size_t, std::size_t>{ 0, Width * Height },
                                     { 7, 40 },
                                     { Width - 1, Width + 1 },
                                     { 100, 4 * Width + 20 },
                                     { 50, 50 } })
  {
    for (std::size_t t = 0; t < Frames; ++t)
    {
      const unsigned short * const frame = mosaics.data() + t * OfPlane.frame;
      std::vector<unsigned short>  buffer(end - begin + 1, 12345);
      EXPECT_EQ(OfPlane.SideBySide(frame, begin, end, buffer.data()), buffer.data());
      for (std::size_t p = begin; p < end; ++p)
      {
        const std::size_t y = 2 * (p / Width) + 1;
        const std::size_t x = 2 * (p % Width) + 1;
        ASSERT_EQ(buffer[p - begin], frame[y * Columns + x]) << begin << " " << p;
      }
      EXPECT_EQ(buffer.back(), 12345) << "more was written than there was room for";
    }
  }
}

TEST(SensorNoisePixelLayout, PixelsSideBySideStayWhereTheyAre)
{
  const std::vector<unsigned short> frames = Mosaics();
  for (const PixelLayout & layout :
       { PixelLayout::OfFrames({ 10, 7, 1 }), PixelLayout::OfPixels(70, 70), PixelLayout::OfPixels(60, 70) })
  {
    unsigned short * const none = nullptr;
    EXPECT_EQ(layout.SideBySide(frames.data() + 2 * layout.frame, 13, 44, none), frames.data() + 153);
  }
}
