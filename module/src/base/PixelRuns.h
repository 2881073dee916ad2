// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PixelRuns_h
#define sensornoise_base_PixelRuns_h

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** Number of pixels of a run, which are processed together with SIMD, so that intermediate results stay in the caches.
 */
inline constexpr std::size_t PixelsPerRun = 512;

/** One number for each pixel of a run. */
using OfRun = std::array<double, PixelsPerRun>;

/** Calls function(first, pixels) for the runs of the pixels [begin, end), one after the other. */
template <typename TFunction>
void
ForRuns(std::size_t begin, std::size_t end, TFunction function)
{
  for (std::size_t first = begin; first < end; first += PixelsPerRun)
  {
    function(first, std::min(PixelsPerRun, end - first));
  }
}

/** Returns the sum of term(i) for i = 0 ... count - 1, in four lanes for SIMD. */
template <typename TTerm>
double
SumOfRun(std::size_t count, TTerm term)
{
  constexpr std::size_t lanes = 4;
  double                sums[lanes] = {};
  std::size_t           i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      sums[lane] += term(i + lane);
    }
  }
  for (; i < count; ++i)
  {
    sums[i % lanes] += term(i);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

} // namespace sensornoise

#endif
