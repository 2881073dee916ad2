// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_FrameNoiseTestHelper_h
#define sensornoise_test_FrameNoiseTestHelper_h

#include "simulation/FrameProcessing.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

/** \file Frames of white noise, and the correlation of their neighbours. */

namespace sensornoise::test
{

/** Returns independent Poisson numbers. */
inline DoubleFrame
PoissonFrame(std::size_t width, std::size_t height, double mean, std::uint64_t seed)
{
  CounterSeededRandom random(seed);
  DoubleFrame         frame(width, height);
  std::generate(frame.values.begin(), frame.values.end(), [&] { return static_cast<double>(random.Poisson(mean)); });
  return frame;
}

/** Returns independent normal numbers with mean 0 and variance 1. */
inline DoubleFrame
NormalFrame(std::size_t width, std::size_t height, std::uint64_t seed)
{
  CounterSeededRandom random(seed);
  DoubleFrame         frame(width, height);
  std::generate(frame.values.begin(), frame.values.end(), [&] { return random.Normal(); });
  return frame;
}

/** Covariances of the noise of an even frame, without a margin of 10 pixels. */
struct FrameCovariance
{
  double variance{ 0.0 };
  double horizontal{ 0.0 }; ///< noise correlation of neighbours in a row
  double vertical{ 0.0 };   ///< noise correlation of neighbours in a column
  double diagonal{ 0.0 };
};

inline FrameCovariance
CovarianceOf(const DoubleFrame & frame)
{
  constexpr std::size_t margin = 10;
  const double          mean =
    std::accumulate(frame.values.begin(), frame.values.end(), 0.0) / static_cast<double>(frame.values.size());
  const auto productAt = [&](std::size_t dx, std::size_t dy) {
    double sum = 0.0;
    for (std::size_t y = margin; y < frame.height - margin; ++y)
    {
      for (std::size_t x = margin; x < frame.width - margin; ++x)
      {
        sum += (frame.Row(y)[x] - mean) * (frame.Row(y + dy)[x + dx] - mean);
      }
    }
    return sum / static_cast<double>((frame.width - 2 * margin) * (frame.height - 2 * margin));
  };
  return { productAt(0, 0), productAt(1, 0), productAt(0, 1), productAt(1, 1) };
}

} // namespace sensornoise::test

#endif
