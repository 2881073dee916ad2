// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/Exposures.h"
#include "sensornoise/Parallel.h"
#include "moments/FrameThumbnails.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t   ExposuresSize = 96; // tiles of 6 x 6 pixels; two rows of each, 12 pixels, are used
constexpr FrameGeometry ExposuresGeometry{ ExposuresSize, ExposuresSize };
constexpr std::size_t   ExposuresPixels = ExposuresSize * ExposuresSize;

std::string
ErrorOf(const std::function<void()> & function)
{
  try
  {
    function();
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "no error";
}

/** Returns the levels of frames with level(t, x) [DN] and normal noise of 2 DN. */
std::vector<ExposureLevel>
LevelsOf(const std::vector<double> &                            exposures,
         const std::function<double(std::size_t t, double x)> & level,
         const std::vector<std::uint8_t> &                      valid = std::vector<std::uint8_t>(ExposuresPixels, 1))
{
  CounterSeededRandom      random(5);
  std::vector<float>       stack;
  std::vector<std::size_t> counted;
  for (std::size_t t = 0; t < exposures.size(); ++t)
  {
    counted.push_back(t);
    for (std::size_t p = 0; p < ExposuresPixels; ++p)
    {
      const double x = static_cast<double>(p % ExposuresSize) / ExposuresSize;
      stack.push_back(static_cast<float>(level(t, x) + 2.0 * random.Normal()));
    }
  }
  FrameThumbnails thumbnails(ExposuresGeometry, exposures.size(), {});
  thumbnails.AddFrames(stack.data(), 0, exposures.size(), SerialFor);
  return FindExposureLevels(thumbnails, counted, exposures, valid);
}
} // namespace

TEST(SensorNoiseExposures, ImpossibleOnesAreRefused)
{
  const auto errorOf = [](const std::vector<double> & exposures) {
    return ErrorOf([&] { ValidateExposures(exposures); });
  };
  EXPECT_EQ(errorOf({}), "no error");
  EXPECT_EQ(errorOf({ 0.0, 1.0, 2.0, 2.0 }), "no error");
  EXPECT_EQ(errorOf({ 1.0, -2.0, 3.0 }),
            "the exposure of frame 1 is -2; expected a finite number, 0 (a dark frame) or more");
  EXPECT_NE(errorOf({ 1.0, 2.0, std::numeric_limits<double>::infinity() }), "no error");
  EXPECT_NE(errorOf({ std::nan(""), 2.0, 3.0 }), "no error");
  EXPECT_EQ(errorOf({ 1.0, 2.0, 2.0 }).find("the exposures have 2 different values; expected at least 3"), 0u);
  EXPECT_EQ(errorOf({ 1.0, 1.0 }).find("the exposures have 1 value; expected at least 3"), 0u);
}

TEST(SensorNoiseExposures, ThereIsOneForEachFrame)
{
  const auto errorOf = [](const std::vector<double> & exposures) {
    return ErrorOf([&] { RequireExposuresOfFrames(exposures, 3); });
  };
  EXPECT_EQ(errorOf({}), "no error");
  EXPECT_EQ(errorOf({ 1.0, 2.0, 3.0 }), "no error");
  EXPECT_EQ(errorOf({ 1.0, 2.0 }),
            "there are 2 exposures, but 3 frames; expected one exposure for each frame, in the order of the frames");
}

TEST(SensorNoiseExposures, LevelsAreThoseOfTheBrightestCellsInTheOrderOfTheExposures)
{
  // The signal is proportional to x. The tiles from 0.9 of the quantile 0.95 on are used: columns from 0.84 to 1.
  const auto levels = LevelsOf({ 2.0, 0.0, 1.0, 2.0 }, [](std::size_t t, double x) {
    return 50.0 + 500.0 * x * (t == 1 ? 0.0 : t == 2 ? 1.0 : 2.0);
  });
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].exposure, 0.0);
  EXPECT_EQ(levels[1].exposure, 1.0);
  EXPECT_EQ(levels[2].exposure, 2.0);
  EXPECT_EQ(levels[0].frames, 1u);
  EXPECT_EQ(levels[2].frames, 2u);
  EXPECT_NEAR(levels[0].meanDn, 50.0, 0.3);
  EXPECT_GT(levels[1].meanDn, 50.0 + 0.84 * 500.0);
  EXPECT_NEAR(levels[2].meanDn - 50.0, 2.0 * (levels[1].meanDn - 50.0), 1.0);
}

TEST(SensorNoiseExposures, CellsWithClippedPixelsAreLeftOutUnlessAllAre)
{
  const auto                level = [](std::size_t t, double x) { return 50.0 + 500.0 * x * static_cast<double>(t); };
  std::vector<std::uint8_t> valid(ExposuresPixels, 1);
  for (std::size_t p = 0; p < ExposuresPixels; ++p)
  {
    valid[p] = p % ExposuresSize < 72 ? 1 : 0; // x below 0.75
  }
  const double whole = LevelsOf({ 1.0, 2.0, 3.0 }, level)[2].meanDn;
  const double part = LevelsOf({ 1.0, 2.0, 3.0 }, level, valid)[2].meanDn;
  EXPECT_LT(part, 50.0 + 1000.0 * 0.75);
  EXPECT_GT(part, 50.0 + 1000.0 * 0.6);
  EXPECT_EQ(LevelsOf({ 1.0, 2.0, 3.0 }, level, std::vector<std::uint8_t>(ExposuresPixels, 0))[2].meanDn, whole);
}

// A flat field: 256 tiles of 12 pixels with 2 DN. The common scatter of the frames is not counted as noise of pixels.
TEST(SensorNoiseExposures, NoiseOfPixelsIsPartedFromTheIllumination)
{
  std::vector<double> exposures;
  for (int i = 0; i < 30; ++i)
  {
    exposures.push_back(1.0 + i % 3);
  }
  const auto levels =
    LevelsOf(exposures, [&](std::size_t t, double) { return 300.0 * exposures[t] * (t % 2 == 0 ? 1.01 : 0.99); });
  ASSERT_EQ(levels.size(), 3u);
  for (const ExposureLevel & level : levels)
  {
    const double expected = 4.0 / (256.0 * 12.0);
    EXPECT_NEAR(level.pixelNoiseDn2, expected, 0.15 * expected); // 9 x 255 degrees of freedom from nearly all tiles
    const double sd = 0.01 * 300.0 * level.exposure;
    EXPECT_NEAR(level.squaresDn2, 10.0 * sd * sd, 0.05 * 10.0 * sd * sd);
  }
}
