// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"
#include "moments/Constants.h"
#include "helpers/ThumbnailTestHelper.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t     Cells = 64;
const std::vector<double> Factors{ 0.2, 0.4, 1.0, 0.7, 1.5, 0.1, 1.2, 0.9 };

double
MeanOf(const std::vector<double> & values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/** Returns the relative standard deviation of the factors [1]. */
double
ChangeOfFactors()
{
  const double mean = MeanOf(Factors);
  double       sum = 0.0;
  for (const double factor : Factors)
  {
    sum += (factor - mean) * (factor - mean);
  }
  return std::sqrt(sum / static_cast<double>(Factors.size() - 1)) / mean;
}

/** Returns the measured illumination change of tiles \a value(t, i), over as many frames as there are factors. */
double
Find(const std::function<double(std::size_t t, std::size_t i)> & value, double noiseDn2 = 1.0)
{
  std::vector<std::vector<double>> frames(Factors.size());
  std::vector<double>              mean(Cells, 0.0);
  for (std::size_t t = 0; t < frames.size(); ++t)
  {
    for (std::size_t i = 0; i < Cells; ++i)
    {
      frames[t].push_back(value(t, i));
      mean[i] += frames[t][i] / static_cast<double>(frames.size());
    }
  }
  return ComputeIlluminationChange(mean, frames, noiseDn2);
}

double
Signal(std::size_t i)
{
  return 100.0 + 40.0 * std::sin(static_cast<double>(i));
}
} // namespace

TEST(SensorNoiseIlluminationChange, OfAScenesContrastForAnyOffset)
{
  for (const double offset : { 0.0, 100.0, -1000.0, 4000.0 })
  {
    EXPECT_NEAR(
      Find([&](std::size_t t, std::size_t i) { return offset + Factors[t] * Signal(i); }), ChangeOfFactors(), 1e-9)
      << offset;
  }
}

// One frame of 100 without light is a relative standard deviation of 10 %, and a change of that frame by 99 %.
TEST(SensorNoiseIlluminationChange, OneUnlitFrameIsAStrongChange)
{
  std::vector<std::vector<double>> frames(100);
  std::vector<double>              mean(Cells, 0.0);
  for (std::size_t t = 0; t < frames.size(); ++t)
  {
    for (std::size_t i = 0; i < Cells; ++i)
    {
      frames[t].push_back(50.0 + (t == 30 ? 0.0 : Signal(i)));
      mean[i] += frames[t][i] / static_cast<double>(frames.size());
    }
  }
  const double change = ComputeIlluminationChange(mean, frames, 1.0);
  EXPECT_NEAR(change, InMoments.strongIlluminationChange / InMoments.strongChangeOfOneFrame, 1e-9);
}

TEST(SensorNoiseIlluminationChange, OfAFlatFieldsLevelInUnitsOfTheNoise)
{
  CounterSeededRandom random(5, 1, 0);
  // With a noise of 0.1 DN per tile the error of each level is 0.1 / sqrt(64 tiles), below 2e-4 of the level.
  const auto   flat = [&](std::size_t t, std::size_t) { return 300.0 + 100.0 * Factors[t] + 0.1 * random.Normal(); };
  const double level = 100.0 * MeanOf(Factors) * ChangeOfFactors();
  const double strong = level * level / InMoments.strongChangeOfFlat; // noise at which the change is just strong
  EXPECT_NEAR(Find(flat, strong) / InMoments.strongIlluminationChange, 1.0, 1e-3);
  EXPECT_NEAR(Find(flat, 4.0 * strong) / InMoments.strongIlluminationChange, 0.5, 1e-3);
  EXPECT_EQ(Find(flat, 0.0), 0.0);
}

TEST(SensorNoiseIlluminationChange, NoiseIsNone)
{
  CounterSeededRandom random(6, 1, 0);
  // A dark flat field: the slopes of the frames are large because of noise, and explain little of the variance.
  EXPECT_LT(Find([&](auto, auto) { return 10.0 + 10.0 * random.Normal(); }), InMoments.strongIlluminationChange);
  EXPECT_EQ(Find([](auto, auto i) { return Signal(i); }), 0.0);
}

TEST(SensorNoiseIlluminationChange, AnotherSceneIsNone)
{
  // The deviation of frame 3 is the difference of the two scenes. The mean frame explains a third of it.
  CounterSeededRandom random(7, 1, 0);
  const auto          scene = [&](std::size_t t, std::size_t i) {
    return t == 3 ? 100.0 + 40.0 * std::sin(1000.0 * random.Uniform()) : Signal(i);
  };
  EXPECT_LT(Find(scene), InMoments.strongIlluminationChange);
}

TEST(SensorNoiseIlluminationChange, ThumbnailsFindThatOfFrames)
{
  constexpr FrameGeometry geometry{ 48, 64 };
  std::vector<double>     stack;
  for (const double factor : Factors)
  {
    for (std::size_t p = 0; p < geometry.Pixels(); ++p)
    {
      stack.push_back(50.0 + factor * (100.0 + 30.0 * std::sin(0.2 * static_cast<double>(p % geometry.width))));
    }
  }
  FrameThumbnails thumbnails(geometry, Factors.size(), {});
  thumbnails.AddFrames(stack.data(), 0, Factors.size(), SerialFor);
  EXPECT_NEAR(thumbnails.FindIlluminationChange(test::AllFrames(thumbnails)), ChangeOfFactors(), 1e-9);
  FrameThumbnails few(geometry, 4, {});
  few.AddFrames(stack.data(), 0, 4, SerialFor);
  EXPECT_EQ(few.FindIlluminationChange(test::AllFrames(few)), 0.0);
}
