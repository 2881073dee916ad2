// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Parallel_h
#define sensornoise_base_Parallel_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Calls a function for 0 ... count-1, in any order and possibly at the same time. */
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)> & function)>;

/** The ParallelFor of one thread. */
inline void
SerialFor(std::size_t count, const std::function<void(std::size_t)> & function)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    function(i);
  }
}

/** Pixels of a block: the unit in which maps are computed and sums are folded. */
inline constexpr std::size_t PixelsPerBlock = 8192;

/** Calls function(begin, end) for blocks of \a count pixels, in any order and possibly at the same time. */
template <typename TFunction>
void
ForBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  parallelFor((count + PixelsPerBlock - 1) / PixelsPerBlock,
              [&](std::size_t b) { function(b * PixelsPerBlock, std::min(count, (b + 1) * PixelsPerBlock)); });
}

/** Sums over \a count pixels: function(pixel, sums) adds one pixel's share to \a sums. Each block is summed on its own
 * and the blocks are folded in order, so that the result has the same bits for any number of threads. */
template <std::size_t VSums, typename TFunction>
std::array<double, VSums>
SumOverBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  std::vector<std::array<double, VSums>> parts((count + PixelsPerBlock - 1) / PixelsPerBlock);
  parallelFor(parts.size(), [&](std::size_t b) {
    std::array<double, VSums> sums{};
    for (std::size_t p = b * PixelsPerBlock; p < std::min(count, (b + 1) * PixelsPerBlock); ++p)
    {
      function(p, sums);
    }
    parts[b] = sums;
  });
  std::array<double, VSums> total{};
  for (const auto & part : parts)
  {
    for (std::size_t k = 0; k < VSums; ++k)
    {
      total[k] += part[k];
    }
  }
  return total;
}

/** The same for sums whose number is known at run time; function(pixel, double * sums). */
template <typename TFunction>
std::vector<double>
SumOverBlocks(std::size_t count, const ParallelFor & parallelFor, std::size_t size, TFunction function)
{
  std::vector<std::vector<double>> parts((count + PixelsPerBlock - 1) / PixelsPerBlock);
  parallelFor(parts.size(), [&](std::size_t b) {
    std::vector<double> sums(size, 0.0);
    for (std::size_t p = b * PixelsPerBlock; p < std::min(count, (b + 1) * PixelsPerBlock); ++p)
    {
      function(p, sums.data());
    }
    parts[b] = std::move(sums);
  });
  std::vector<double> total(size, 0.0);
  for (const auto & part : parts)
  {
    for (std::size_t k = 0; k < size; ++k)
    {
      total[k] += part[k];
    }
  }
  return total;
}

} // namespace sensornoise

#endif
