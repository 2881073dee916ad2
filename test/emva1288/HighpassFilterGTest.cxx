// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;

namespace
{
/** Returns an image of width x height with value(x, y). */
template <typename TFunction>
std::vector<double>
MakeImage(std::size_t width, std::size_t height, TFunction value)
{
  std::vector<double> image;
  for (std::size_t y = 0; y < height; ++y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      image.push_back(value(static_cast<double>(x), static_cast<double>(y)));
    }
  }
  return image;
}

/** Returns the mean over the window of (2 radius + 1)^2 pixels around a pixel. */
double
BoxMean(const std::vector<double> & image, std::size_t width, std::size_t x, std::size_t y, std::size_t radius)
{
  double sum = 0.0;
  for (std::size_t j = y - radius; j <= y + radius; ++j)
  {
    for (std::size_t i = x - radius; i <= x + radius; ++i)
    {
      sum += image[j * width + i];
    }
  }
  return sum / std::pow(2.0 * static_cast<double>(radius) + 1.0, 2);
}

/** Returns the image after a box of (2 radius + 1)^2 pixels; pixels too near to the border keep their value. */
std::vector<double>
Box(const std::vector<double> & image, std::size_t width, std::size_t radius)
{
  std::vector<double> result = image;
  const std::size_t   height = image.size() / width;
  for (std::size_t y = radius; y + radius < height; ++y)
  {
    for (std::size_t x = radius; x + radius < width; ++x)
    {
      result[y * width + x] = BoxMean(image, width, x, y, radius);
    }
  }
  return result;
}
} // namespace

TEST(SensorNoiseEmvaHighpass, SubtractsTwoBoxesAndABinomialMaskOneAfterTheOther)
{
  constexpr std::size_t     width = 23;
  constexpr std::size_t     height = 22;
  const std::vector<double> image =
    MakeImage(width, height, [](double x, double y) { return std::sin(7.1 * x + 0.3 * y * y) + 0.1 * x * y; });
  const std::vector<double> boxes = Box(Box(image, width, 3), width, 5);
  const HighpassImage       filtered = FilterHighpass(image, width, height, test::Threads(3));
  ASSERT_EQ(filtered.columns, width - 18);
  ASSERT_EQ(filtered.rows, height - 18);
  constexpr double mask[3] = { 0.25, 0.5, 0.25 };
  for (std::size_t y = 0; y < filtered.rows; ++y)
  {
    for (std::size_t x = 0; x < filtered.columns; ++x)
    {
      double smooth = 0.0;
      for (std::size_t j = 0; j < 3; ++j)
      {
        for (std::size_t i = 0; i < 3; ++i)
        {
          smooth += mask[i] * mask[j] * boxes[(y + 8 + j) * width + x + 8 + i];
        }
      }
      EXPECT_NEAR(filtered.pixels[y * filtered.columns + x], image[(y + 9) * width + x + 9] - smooth, 1e-12);
    }
  }
}

TEST(SensorNoiseEmvaHighpass, RemovesAnEvenSlopeOfTheIllumination)
{
  const std::vector<double> ramp = MakeImage(40, 30, [](double x, double y) { return 500.0 + 3.0 * x - 2.0 * y; });
  for (const double pixel : FilterHighpass(ramp, 40, 30).pixels)
  {
    EXPECT_NEAR(pixel, 0.0, 1e-10);
  }
}

TEST(SensorNoiseEmvaHighpass, KeepsNearlyAllOfTheVarianceOfWhiteNoise)
{
  // The documentation states what the filter takes from the standard deviation of pixels, and of columns or rows.
  const auto & kernel = EmvaLowpassKernel();
  const double squares = std::inner_product(kernel.begin(), kernel.end(), kernel.begin(), 0.0);
  const double centre = kernel[EmvaFilterRadius];
  EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1.0, 1e-14);
  EXPECT_NEAR(centre, 1.0 / 11.0, 1e-14); // the box of 11 is flat about its centre
  EXPECT_NEAR(std::sqrt(1.0 - 2.0 * centre * centre + squares * squares), 0.994, 0.0005);
  EXPECT_NEAR(std::sqrt(1.0 - 2.0 * centre + squares), 0.943, 0.0005);
}

TEST(SensorNoiseEmvaHighpass, NeedsRoom)
{
  EXPECT_TRUE(HasRoomForHighpass(21, 21));
  EXPECT_FALSE(HasRoomForHighpass(20, 100));
  EXPECT_FALSE(HasRoomForHighpass(100, 20));
}
