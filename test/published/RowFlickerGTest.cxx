// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/Flicker.h"
#include "published/PublishedScene.h"

#include <algorithm>
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
constexpr std::size_t Width = 12;
constexpr std::size_t Height = 60;
constexpr std::size_t Frames = 40;

using Flicker = std::function<double(std::size_t t, std::size_t y)>;

double
GlobalFlicker(std::size_t t, std::size_t)
{
  return 0.05 * std::sin(2.3 * static_cast<double>(t));
}

/** Returns gamma of a lamp with a period of 25 rows. */
double
RowFlicker(std::size_t t, std::size_t y)
{
  return 0.05 * std::sin(0.25 * static_cast<double>(y) + 2.3 * static_cast<double>(t));
}

/** Frames of mean 1000 with flicker and normal noise. The rows [firstRow, lastRow) are the row set. */
struct Stack
{
  std::vector<double>              mean;
  std::vector<std::vector<double>> frames;
  IsoIntensitySet                  rowSet;
  IsoIntensitySet                  dark;

  Stack(const Flicker & flicker, double noise, std::size_t firstRow = 0, std::size_t lastRow = Height)
    : mean(Width * Height, 1000.0)
  {
    std::mt19937_64            random(12);
    std::normal_distribution<> normal(0.0, 1.0);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      std::vector<double> frame(mean.size());
      for (std::size_t p = 0; p < frame.size(); ++p)
      {
        frame[p] = mean[p] * (1.0 + flicker(t, p / Width)) + noise * normal(random);
      }
      frames.push_back(frame);
    }
    double total = 0.0;
    for (std::size_t p = firstRow * Width; p < lastRow * Width; ++p)
    {
      rowSet.pixels.push_back(static_cast<std::uint32_t>(p));
      rowSet.weights.push_back(1.0 + 0.5 * std::sin(static_cast<double>(p)));
      total += rowSet.weights.back();
    }
    std::for_each(rowSet.weights.begin(), rowSet.weights.end(), [total](double & weight) { weight /= total; });
  }
  FlickerSums
  Sums() const
  {
    FlickerSums sums(rowSet, dark, mean.data(), { Width, Height, 1 }, Frames, rowSet);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      sums.AddFrame(frames[t].data(), t);
    }
    return sums;
  }
  /** Returns the same scene with x and y exchanged. */
  FlickerSums
  TransposedSums() const
  {
    const auto place = [](std::size_t p) { return p % Width * Height + p / Width; };
    const auto transposed = [&](const std::vector<double> & map) {
      std::vector<double> out(map.size());
      for (std::size_t p = 0; p < map.size(); ++p)
      {
        out[place(p)] = map[p];
      }
      return out;
    };
    IsoIntensitySet set = rowSet;
    for (std::uint32_t & p : set.pixels)
    {
      p = static_cast<std::uint32_t>(place(p));
    }
    const auto  mapOfMeans = transposed(mean);
    FlickerSums sums(set, dark, mapOfMeans.data(), { Height, Width, 0 }, Frames, set);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      sums.AddFrame(transposed(frames[t]).data(), t);
    }
    return sums;
  }
};
} // namespace

TEST(SensorNoiseRowFlicker, RowWeightsSumToOne)
{
  const FlickerSums sums = Stack(RowFlicker, 0.0).Sums();
  double            sum = 0.0;
  for (std::size_t y = 0; y < Height; ++y)
  {
    sum += sums.GetRowWeight(y);
  }
  EXPECT_EQ(sums.GetNumberOfRows(), Height);
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(SensorNoiseRowFlicker, GlobalFlickerIsNotModelledByRow)
{
  // The flicker is modelled by row only if this reduces the cross-validation error by 1 %, more than chance does with
  // 2,400 row errors.
  EXPECT_EQ(ChooseSigmaRows(Stack(GlobalFlicker, 20.0).Sums()), 0.0);
  EXPECT_EQ(ChooseSigmaRows(Stack([](std::size_t, std::size_t) { return 0.0; }, 20.0).Sums()), 0.0);
}

TEST(SensorNoiseRowFlicker, RowFlickerIsModelledByRow)
{
  // Half a period is 12.6 rows: a wider kernel averages the pulse away, a narrower kernel leaves noise.
  const double sigma = ChooseSigmaRows(Stack(RowFlicker, 20.0).Sums());
  EXPECT_GE(sigma, 1.0);
  EXPECT_LE(sigma, 6.0);
}

TEST(SensorNoiseRowFlicker, MoreNoiseAsksForAWiderKernel)
{
  EXPECT_LT(ChooseSigmaRows(Stack(RowFlicker, 5.0).Sums()), ChooseSigmaRows(Stack(RowFlicker, 150.0).Sums()));
}

TEST(SensorNoiseRowFlicker, SmoothingAConstantLeavesIt)
{
  const Stack       stack(GlobalFlicker, 0.0);
  const FlickerSums sums = stack.Sums();
  for (const double sigma : { 0.4, 1.0, 7.0, 1000.0 })
  {
    const RowRatios ratios = SmoothRowRatios(sums, sigma);
    EXPECT_EQ(ratios.sigmaRows, sigma);
    for (std::size_t i = 0; i < ratios.ratio.size(); ++i)
    {
      ASSERT_NEAR(ratios.ratio[i], 1.0 + GlobalFlicker(i / Height, 0), 1e-12) << sigma;
    }
  }
}

TEST(SensorNoiseRowFlicker, RatiosEqualBruteForce)
{
  // (3.28) pixel by pixel: weights times exp(-(y - y')^2 / (2 sigma_y^2)), cut at 4 sigma_y.
  const Stack     stack(RowFlicker, 20.0, 5, 40);
  const double    sigma = 2.5;
  const RowRatios ratios = SmoothRowRatios(stack.Sums(), sigma);
  for (const std::size_t t : { std::size_t{ 0 }, Frames - 1 })
  {
    for (std::size_t y = 5; y < 40; ++y)
    {
      double sum = 0.0;
      double weights = 0.0;
      for (std::size_t i = 0; i < stack.rowSet.pixels.size(); ++i)
      {
        const std::size_t p = stack.rowSet.pixels[i];
        const double      distance = static_cast<double>(p / Width) - static_cast<double>(y);
        if (std::abs(distance) <= 4.0 * sigma)
        {
          const double weight = stack.rowSet.weights[i] * std::exp(-0.5 * distance * distance / (sigma * sigma));
          sum += weight * stack.frames[t][p] / stack.mean[p];
          weights += weight;
        }
      }
      ASSERT_NEAR(ratios.ratio[t * Height + y], sum / weights, 1e-12) << t << ' ' << y;
    }
  }
}

TEST(SensorNoiseRowFlicker, RowsBeyondReachAreNotKnown)
{
  const RowRatios ratios = SmoothRowRatios(Stack(RowFlicker, 20.0, 20, 30).Sums(), 3.7);
  for (std::size_t y = 0; y < Height; ++y)
  {
    EXPECT_EQ(ratios.known[y], y >= 17 && y <= 32 ? 1 : 0) << y; // within 3.7 rows of 20 ... 29
    if (ratios.known[y] == 0)
    {
      EXPECT_EQ(ratios.ratio[y], 1.0) << y;
    }
  }
}

TEST(SensorNoiseRowFlicker, ColumnsOfTheTransposedSceneAreItsRows)
{
  const Stack       stack(RowFlicker, 20.0, 10, 50);
  const FlickerSums rows = stack.Sums();
  const FlickerSums columns = stack.TransposedSums();
  EXPECT_EQ(ChooseSigmaRows(rows), ChooseSigmaRows(columns));
  const RowRatios byRow = SmoothRowRatios(rows, 3.0);
  const RowRatios byColumn = SmoothRowRatios(columns, 3.0);
  EXPECT_EQ(byRow.known, byColumn.known);
  EXPECT_EQ(byRow.ratio, byColumn.ratio); // same order of the pixels of a row: same bits
}
