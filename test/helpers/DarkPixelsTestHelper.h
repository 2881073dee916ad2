// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_DarkPixelsTestHelper_h
#define sensornoise_test_DarkPixelsTestHelper_h

#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "mosaic/MosaicGeometry.h"
#include "simulation/Random.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

/** \file
 * Dark frames of a sensor whose pixels differ. */

namespace sensornoise::test
{

/** True values of every pixel. */
struct DarkSensor
{
  std::vector<double> offsetDn;
  std::vector<double> readNoiseDn;
};

/** Makes pixels about 100.3 DN with offsets of the given scatter, and the noise that \a noiseOf draws [DN]. */
inline DarkSensor
MakeDarkSensor(std::size_t                                          pixels,
               double                                               offsetSdDn,
               const std::function<double(CounterSeededRandom &)> & noiseOf,
               std::uint64_t                                        seed = 1)
{
  CounterSeededRandom random(seed, 1);
  DarkSensor          sensor;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    sensor.offsetDn.push_back(100.3 + offsetSdDn * random.Normal());
    sensor.readNoiseDn.push_back(noiseOf(random));
  }
  return sensor;
}

/** Returns log-normal noise of median 3 DN. The logarithm is higher by |N(0, 1)| for the fraction \a tail of the
 * pixels. */
inline std::function<double(CounterSeededRandom &)>
LogNormalNoise(double spread, double tail = 0.0)
{
  return [=](CounterSeededRandom & random) {
    const double core = spread * random.Normal();
    const double excess = std::abs(random.Normal());
    return 3.0 * std::exp(core + (random.Uniform() < tail ? excess : 0.0));
  };
}

/** Returns frames one after the other; integers are rounded. \a driftDn is added to all pixels of a frame. */
template <typename TPixel>
Stack<TPixel>
DarkStackOf(const DarkSensor &          sensor,
            std::size_t                 frames,
            const std::vector<double> & driftDn = {},
            std::uint64_t               seed = 1)
{
  const std::size_t pixels = sensor.offsetDn.size();
  Stack<TPixel>     stack{ pixels, 1, frames, std::vector<TPixel>(pixels * frames) };
  for (std::size_t t = 0; t < frames; ++t)
  {
    CounterSeededRandom random(seed, 2, t);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const double value =
        sensor.offsetDn[p] + sensor.readNoiseDn[p] * random.Normal() + (driftDn.empty() ? 0.0 : driftDn[t]);
      stack.pixels[t * pixels + p] =
        static_cast<TPixel>(std::is_integral_v<TPixel> ? std::clamp(std::round(value), 0.0, 4000.0) : value);
    }
  }
  return stack;
}

/** Returns the results of dark frames without their drift, added \a chunk frames at a time. */
template <typename TPixel>
KnownOffset
MeasureDarkStack(const Stack<TPixel> &             stack,
                 const std::vector<std::uint8_t> & mask = {},
                 const ParallelFor &               parallelFor = SerialFor,
                 std::size_t                       chunk = 1000)
{
  DarkFrameSums<TPixel> sums(FrameGeometry{ stack.width, stack.height }, mask);
  for (std::size_t first = 0; first < stack.frames; first += chunk)
  {
    sums.AddFrames(stack.Frame(first), std::min(chunk, stack.frames - first), parallelFor);
  }
  return sums.Measure({}, parallelFor).front();
}

/** Returns the middle value. */
inline double
MedianOfPixels(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

} // namespace sensornoise::test

#endif
