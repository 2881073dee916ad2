// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Parallel_h
#define sensornoise_Parallel_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Function that calls \a function for each of 0 ... count-1, in any order and possibly at the same time, and returns
 * when all calls have ended. */
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)> & function)>;

/** ParallelFor with one thread: calls \a function for 0 ... count-1 in ascending order. */
inline void
SerialFor(std::size_t count, const std::function<void(std::size_t)> & function)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    function(i);
  }
}

/** Number of pixels of a block. Maps are computed block by block, and sums are folded block by block. */
inline constexpr std::size_t PixelsPerBlock = 8192;

/** Calls function(begin, end) for each block of \a count pixels, in any order and possibly at the same time. */
template <typename TFunction>
void
ForBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  parallelFor((count + PixelsPerBlock - 1) / PixelsPerBlock,
              [&](std::size_t b) { function(b * PixelsPerBlock, std::min(count, (b + 1) * PixelsPerBlock)); });
}

/** Calls function(pixel) for each of \a count pixels, block by block, in any order and possibly at the same time. */
template <typename TFunction>
void
ForPixels(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  ForBlocks(count, parallelFor, [&function](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      function(p);
    }
  });
}

/** Returns the results of all blocks of \a count pixels, in the order of the blocks. function(begin, end, part)
 * computes the result of one block in \a part, which is value-initialised before. */
template <typename TPart, typename TFunction>
std::vector<TPart>
PartsOfBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  std::vector<TPart> parts((count + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(count, parallelFor, [&](std::size_t begin, std::size_t end) {
    TPart part{};
    function(begin, end, part);
    parts[begin / PixelsPerBlock] = part;
  });
  return parts;
}

/** Returns \a VSums sums over \a count pixels. function(begin, end, sums) adds the terms of a block to \a sums. Each
 * block is summed separately, and the blocks are added in their order: the result has the same bits for any number of
 * threads. */
template <std::size_t VSums, typename TFunction>
std::array<double, VSums>
SumBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  std::array<double, VSums> total{};
  for (const auto & part : PartsOfBlocks<std::array<double, VSums>>(count, parallelFor, function))
  {
    for (std::size_t k = 0; k < VSums; ++k)
    {
      total[k] += part[k];
    }
  }
  return total;
}

/** Returns the sums of SumBlocks() for a function(pixel, sums), which adds the terms of one pixel. */
template <std::size_t VSums, typename TFunction>
std::array<double, VSums>
SumOverBlocks(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  return SumBlocks<VSums>(count, parallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    for (std::size_t p = begin; p < end; ++p)
    {
      function(p, sums);
    }
  });
}

/** Largest number of parts of a map whose sums are held at the same time where there may be thousands of sums. With 64,
 * each of 16 threads has four parts. */
inline constexpr std::size_t MostSummedParts = 64;

/** Returns \a size sums over \a count pixels, folded as above, but part by part: at most MostSummedParts parts of whole
 * blocks. function(begin, end, double * sums) adds the terms of a block. */
template <typename TFunction>
std::vector<double>
SumBlocks(std::size_t count, const ParallelFor & parallelFor, std::size_t size, TFunction function)
{
  const std::size_t                blocks = (count + PixelsPerBlock - 1) / PixelsPerBlock;
  const std::size_t                pixelsOfPart = (blocks + MostSummedParts - 1) / MostSummedParts * PixelsPerBlock;
  const std::size_t                numberOfParts = count > 0 ? (count + pixelsOfPart - 1) / pixelsOfPart : 0;
  std::vector<std::vector<double>> parts(numberOfParts);
  parallelFor(numberOfParts, [&](std::size_t k) {
    std::vector<double> sums(size, 0.0);
    const std::size_t   end = std::min(count, (k + 1) * pixelsOfPart);
    for (std::size_t begin = k * pixelsOfPart; begin < end; begin += PixelsPerBlock)
    {
      function(begin, std::min(end, begin + PixelsPerBlock), sums.data());
    }
    parts[k] = std::move(sums);
  });
  std::vector<double> total(size, 0.0);
  for (const auto & part : parts)
  {
    std::transform(part.begin(), part.end(), total.begin(), total.begin(), std::plus<>());
  }
  return total;
}

/** Returns \a size sums over \a count pixels. function(pixel, double * sums) adds the terms of one pixel. */
template <typename TFunction>
std::vector<double>
SumOverBlocks(std::size_t count, const ParallelFor & parallelFor, std::size_t size, TFunction function)
{
  return SumBlocks(count, parallelFor, size, [&](std::size_t begin, std::size_t end, double * sums) {
    for (std::size_t p = begin; p < end; ++p)
    {
      function(p, sums);
    }
  });
}

} // namespace sensornoise

#endif
