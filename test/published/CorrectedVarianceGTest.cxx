// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/Flicker.h"
#include "sensornoise/FrameGeometry.h"
#include "base/PixelLayout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 9;
constexpr std::size_t Height = 7;
constexpr std::size_t Pixels = Width * Height;
constexpr std::size_t Frames = 21;
const PixelLayout     Layout = PixelLayout::OfFrames({ Width, Height, 1 });
constexpr double      OffsetDn = 100.0;

enum class FlickerOf
{
  Whole,
  Rows,
  Columns
};

FrameGeometry
GeometryOf(FlickerOf part)
{
  return { Width, Height, part == FlickerOf::Columns ? 0U : 1U };
}

/** Returns random flicker whose mean over time is not 0; the class centres it. */
FlickerEstimate
RandomFlicker(FlickerOf part)
{
  std::mt19937_64            random(21);
  std::normal_distribution<> normal(0.01, 0.05);
  FlickerEstimate            flicker;
  flicker.offsetDn = OffsetDn;
  for (std::size_t t = 0; t < Frames; ++t)
  {
    flicker.gamma.push_back(normal(random));
  }
  if (part != FlickerOf::Whole)
  {
    flicker.rows = GeometryOf(part).Rows();
    flicker.rowKnown.assign(flicker.rows, 1);
    for (std::size_t i = 0; i < Frames * flicker.rows; ++i)
    {
      flicker.gammaRows.push_back(normal(random));
    }
  }
  return flicker;
}

/** Returns frames with the flicker and noise, as digital numbers of 16 bits. */
std::vector<std::uint16_t>
FramesWith(const FlickerEstimate & flicker, const FrameGeometry & geometry)
{
  std::mt19937_64            random(22);
  std::normal_distribution<> normal(0.0, 1.0);
  std::vector<std::uint16_t> stack(Frames * Pixels);
  for (std::size_t i = 0; i < stack.size(); ++i)
  {
    const std::size_t p = i % Pixels;
    const double      flux = (1.0 + flicker.Gamma(i / Pixels, geometry.RowOf(p))) * 50.0 * static_cast<double>(1 + p);
    stack[i] = static_cast<std::uint16_t>(OffsetDn + flux + 8.0 + std::sqrt(flux) * normal(random));
  }
  return stack;
}

/** Returns mean and squared deviations of values over time, by two passes in long double. */
struct Series
{
  long double mean{ 0.0L };
  long double squares{ 0.0L };

  template <typename TFunction>
  explicit Series(TFunction value)
  {
    for (std::size_t t = 0; t < Frames; ++t)
    {
      mean += value(t) / Frames;
    }
    for (std::size_t t = 0; t < Frames; ++t)
    {
      squares += (value(t) - mean) * (value(t) - mean);
    }
  }
};

/** Returns the variance of u^ = u - (1 + gamma_t)(ubar - mu), frame by frame as in (3.18). */
void
ExpectVarianceOfTheExplicitStack(FlickerOf part)
{
  const FrameGeometry   geometry = GeometryOf(part);
  const FlickerEstimate flicker = RandomFlicker(part);
  const auto            stack = FramesWith(flicker, geometry);
  CorrectedVariance     corrected(flicker, geometry, Frames);
  for (std::size_t y = 0; y < Height; ++y)
  {
    corrected.AddRow(stack.data(), Layout, Frames, 0, y);
  }
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const Series raw([&](std::size_t t) { return static_cast<long double>(stack[t * Pixels + p]); });
    const Series hat([&](std::size_t t) {
      const long double gamma = flicker.Gamma(t, geometry.RowOf(p));
      return stack[t * Pixels + p] - (1.0L + gamma) * (raw.mean - static_cast<long double>(OffsetDn));
    });
    const auto   expected = static_cast<double>(hat.squares / (Frames - 1));
    // gamma_t is rounded to multiples of 2^-36, by d = 4e-12 rms, which adds 2 flux d noise / sqrt(frames). Relative to
    // the variance, noise^2 >= flux, this is at most 2 sqrt(3200) 4e-12 / sqrt(21) = 1e-10 rms. The guaranteed accuracy
    // is 1e-9.
    ASSERT_NEAR(corrected.GetVariance(p, static_cast<double>(raw.mean), static_cast<double>(raw.squares)),
                expected,
                1e-9 * expected)
      << p;
  }
}
} // namespace

TEST(SensorNoiseCorrectedVariance, EqualsVarianceOfTheExplicitStackForWholeFrames)
{
  ExpectVarianceOfTheExplicitStack(FlickerOf::Whole);
}

TEST(SensorNoiseCorrectedVariance, EqualsVarianceOfTheExplicitStackByRow)
{
  ExpectVarianceOfTheExplicitStack(FlickerOf::Rows);
}

TEST(SensorNoiseCorrectedVariance, EqualsVarianceOfTheExplicitStackByColumn)
{
  ExpectVarianceOfTheExplicitStack(FlickerOf::Columns);
}

TEST(SensorNoiseCorrectedVariance, ChunksAndOrderOfRowsChangeNoBit)
{
  for (const FlickerOf part : { FlickerOf::Whole, FlickerOf::Rows, FlickerOf::Columns })
  {
    const FrameGeometry   geometry = GeometryOf(part);
    const FlickerEstimate flicker = RandomFlicker(part);
    const auto            stack = FramesWith(flicker, geometry);
    CorrectedVariance     whole(flicker, geometry, Frames);
    for (std::size_t y = 0; y < Height; ++y)
    {
      whole.AddRow(stack.data(), Layout, Frames, 0, y);
    }
    CorrectedVariance chunks(flicker, geometry, Frames);
    for (std::size_t t = 0; t < Frames; t += 4)
    {
      for (std::size_t y = Height; y-- > 0;)
      {
        chunks.AddRow(stack.data() + t * Pixels, Layout, std::min<std::size_t>(4, Frames - t), t, y);
      }
    }
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      ASSERT_EQ(whole.GetVariance(p, 500.0, 1e5), chunks.GetVariance(p, 500.0, 1e5)) << p;
    }
  }
}

TEST(SensorNoiseCorrectedVariance, OrderOfIntegerFramesAndMergesChangeNoBit)
{
  for (const FlickerOf part : { FlickerOf::Whole, FlickerOf::Rows, FlickerOf::Columns })
  {
    const FrameGeometry   geometry = GeometryOf(part);
    const FlickerEstimate flicker = RandomFlicker(part);
    const auto            stack = FramesWith(flicker, geometry);
    CorrectedVariance     whole(flicker, geometry, Frames);
    CorrectedVariance     parts[2] = { whole, whole };
    for (std::size_t y = 0; y < Height; ++y)
    {
      whole.AddRow(stack.data(), Layout, Frames, 0, y);
      for (std::size_t t = Frames; t-- > 0;)
      {
        parts[t % 2].AddRow(stack.data() + t * Pixels, Layout, 1, t, y);
      }
    }
    std::stringstream sums;
    parts[1].Save(sums);
    parts[1].Forget();
    parts[1].Merge(sums);
    parts[0].Save(sums);
    parts[1].Merge(sums);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      ASSERT_EQ(whole.GetVariance(p, 500.0, 1e5), parts[1].GetVariance(p, 500.0, 1e5)) << p;
    }
    EXPECT_THROW(parts[1].Merge(sums), std::runtime_error);
  }
}

TEST(SensorNoiseCorrectedVariance, NoiseFreeFlickerLeavesNothing)
{
  const FlickerEstimate flicker = RandomFlicker(FlickerOf::Rows);
  const FrameGeometry   geometry = GeometryOf(FlickerOf::Rows);
  std::vector<double>   stack(Frames * Pixels);
  const std::size_t     p = 3 * Width + 4;
  double                meanGamma = 0.0;
  for (std::size_t t = 0; t < Frames; ++t)
  {
    meanGamma += flicker.Gamma(t, 3) / Frames;
  }
  // gamma is relative to the mean: u = mu + (1 + gamma - its mean) flux
  const auto value = [&](std::size_t t) { return OffsetDn + (1.0 + flicker.Gamma(t, 3) - meanGamma) * 2000.0; };
  for (std::size_t t = 0; t < Frames; ++t)
  {
    stack[t * Pixels + p] = value(t);
  }
  const Series      raw([&](std::size_t t) { return static_cast<long double>(value(t)); });
  CorrectedVariance corrected(flicker, geometry, Frames);
  corrected.AddRow(stack.data(), Layout, Frames, 0, 3);
  // The raw variance, (0.05 * 2000)^2 = 1e4 DN^2, cancels within double precision.
  EXPECT_NEAR(corrected.GetVariance(p, static_cast<double>(raw.mean), static_cast<double>(raw.squares)), 0.0, 1e-9);
  EXPECT_GT(static_cast<double>(raw.squares) / (Frames - 1), 1e3);
}

TEST(SensorNoiseCorrectedVariance, RowsThatAreNotKnownGiveNaN)
{
  for (const FlickerOf part : { FlickerOf::Rows, FlickerOf::Columns })
  {
    FlickerEstimate flicker = RandomFlicker(part);
    flicker.rowKnown[2] = 0;
    const FrameGeometry     geometry = GeometryOf(part);
    const CorrectedVariance corrected(flicker, geometry, Frames);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      const std::size_t row = part == FlickerOf::Rows ? p / Width : p % Width;
      EXPECT_EQ(std::isnan(corrected.GetVariance(p, 500.0, 1e5)), row == 2) << p;
    }
  }
}
