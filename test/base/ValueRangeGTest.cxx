// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/ValueRange.h"
#include "sensornoise/base/Parallel.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

TEST(SensorNoiseValueRange, RangeOfAMapIsThatOfItsPixels)
{
  for (const std::size_t pixels : { 0U, 1U, 7U, 8U, 21U, 20001U })
  {
    std::vector<float>        values(pixels);
    std::vector<std::uint8_t> mask(pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      values[p] = static_cast<float>(100.0 * std::sin(static_cast<double>(3 * p)));
      mask[p] = p % 5 == 2 ? 0 : 3;
      values[p] = mask[p] == 0 ? std::nanf("") : values[p];
    }
    const ValueRange range = RangeOfMap(values.data(), mask.data(), pixels, SerialFor);
    const ValueRange expected = RangeOverPixels(
      pixels,
      SerialFor,
      [&](std::size_t p) { return mask[p] != 0; },
      [&](std::size_t p) { return static_cast<double>(values[p]); });
    EXPECT_EQ(range.lowest, expected.lowest) << pixels;
    EXPECT_EQ(range.highest, expected.highest) << pixels;
    EXPECT_EQ(range.values, expected.values) << pixels;
  }
}
