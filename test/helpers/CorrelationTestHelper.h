// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_CorrelationTestHelper_h
#define sensornoise_test_CorrelationTestHelper_h

#include "base/Eigen.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/FrameSample.h"
#include "simulation/FrameProcessing.h"
#include "helpers/FrameNoiseTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

/** \file
 * Noise of a few frames, without a scene, and what is left of it. */

namespace sensornoise::test::correlation
{

/** The noise of a frame. */
using FrameOf = std::function<DoubleFrame(std::size_t t)>;

/** Returns a signal that grows from left to right, the same in every row [DN]. */
inline std::vector<double>
Ramp(const FrameGeometry & geometry, double low, double high)
{
  std::vector<double> signal(geometry.Pixels());
  for (std::size_t p = 0; p < signal.size(); ++p)
  {
    const auto x = static_cast<double>(p % geometry.width) / static_cast<double>(geometry.width - 1);
    signal[p] = low + (high - low) * x;
  }
  return signal;
}

inline NoiseSample
SampleOf(const FrameGeometry & geometry, std::size_t frames, const FrameOf & frameOf)
{
  const std::vector<double> none(geometry.Pixels(), 0.0);
  auto                      sample = FrameSample::Of<double>(geometry, frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    sample.AddFrames(frameOf(t).values.data(), t, 1, none);
  }
  return sample.TakeNoise(none);
}

/** Returns the residuals of all pixels; black is 0. */
inline NoiseResiduals
ComputeResiduals(const FrameGeometry &       geometry,
                 std::size_t                 frames,
                 const std::vector<double> & signal,
                 const FrameOf &             frameOf,
                 const Eigen::MatrixXd &     series = {})
{
  const std::vector<std::uint8_t> all(geometry.Pixels(), 1);
  return { SampleOf(geometry, frames, frameOf), series, { signal, all, 0.0 }, SerialFor };
}

/** Returns ofTile(i) of every tile. */
template <typename TOfTile>
auto
OfTiles(const NoiseResiduals & residuals, const ParallelFor & parallelFor, TOfTile ofTile)
{
  std::vector<decltype(ofTile(std::size_t{}))> sums(residuals.GetTiles().origins.size());
  parallelFor(sums.size(), [&](std::size_t i) { sums[i] = ofTile(i); });
  return sums;
}

/** Returns white normal noise, 1 DN. */
inline FrameOf
WhiteNoise(const FrameGeometry & geometry, std::uint64_t seed)
{
  return [=](std::size_t t) { return NormalFrame(geometry.width, geometry.height, 1000 * seed + t); };
}

/** Expects figure \a k to be right within 4.5 of its standard errors, which may be at most \a largestError. */
inline void
ExpectFigure(const JackknifeEstimate & estimate, Eigen::Index k, double expected, double largestError)
{
  EXPECT_NEAR(estimate.value(k), expected, 4.5 * estimate.StandardError(k)) << "figure " << k;
  EXPECT_GT(estimate.StandardError(k), 0.0) << "figure " << k;
  EXPECT_LT(estimate.StandardError(k), largestError) << "figure " << k;
}

} // namespace sensornoise::test::correlation

#endif
