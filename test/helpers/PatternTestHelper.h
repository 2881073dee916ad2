// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_PatternTestHelper_h
#define sensornoise_test_PatternTestHelper_h

#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

/** \file
 * Maps of mean and variance of a sensor whose pixels differ. */

namespace sensornoise::test::pattern
{

inline constexpr std::size_t Size = 256;
inline constexpr std::size_t Pixels = Size * Size;
inline constexpr std::size_t FewFrames = 20;
inline constexpr std::size_t ManyFrames = 1000000000000; // the means have no noise to speak of
inline constexpr double      BlackDn = 100.0;
inline constexpr double      GainDn = 0.5;            // per electron
inline constexpr double      ReadVarianceDn2 = 400.0; // so that the weights hardly depend on the level

/** Properties of a pixel: its signal [DN at the mean gain], its gain, efficiency and offset. */
struct Pixel
{
  double lightDn;
  double gain{ 1.0 };       // relative
  double efficiency{ 1.0 }; // relative
  double offsetDn{ 0.0 };
};

/** The maps. The means have noise. The variances have none, because their degrees of freedom are many. */
struct Maps
{
  ReferenceFrame      frame;
  std::vector<double> variance;
  std::vector<float>  dof = std::vector<float>(Pixels, 1e4F);

  explicit Maps(const std::function<Pixel(std::size_t x, std::size_t y)> & pixelAt, std::size_t frames = ManyFrames)
  {
    std::mt19937               random(5);
    std::normal_distribution<> normal;
    std::vector<double>        mean;
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      const Pixel  pixel = pixelAt(p % Size, p / Size);
      const double lightDn = pixel.gain * pixel.efficiency * pixel.lightDn;
      variance.push_back(ReadVarianceDn2 + GainDn * pixel.gain * lightDn);
      mean.push_back(BlackDn + pixel.offsetDn + lightDn +
                     std::sqrt(variance.back() / static_cast<double>(frames)) * normal(random));
    }
    frame = MakeReferenceFrame(mean, variance, std::vector<std::uint8_t>(Pixels, 1), { Size, Size, 1 }, frames);
  }
  VarianceData
  Data() const
  {
    return {
      frame.mean.data(), frame.neighbourMean.data(), { variance.data() }, dof.data(), frame.usable.data(), Pixels
    };
  }
};

/** Returns a signal that rises from 50 to 150 DN down the frame: smooth, with less than half a DN from row to row. */
inline double
Ramp(std::size_t y)
{
  return 50.0 + 100.0 * static_cast<double>(y) / (Size - 1.0);
}

} // namespace sensornoise::test::pattern

#endif
