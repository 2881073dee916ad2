// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/IntegerMoments.h"

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/base/WideVectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

namespace
{

/** Name of the sums in a stream. */
template <typename TPixel>
std::string
IntegerStreamName()
{
  return "IntegerMoments " + PixelName<TPixel>();
}

/** Frames whose values are added in registers, before they are to the sums of a block, which have more memory than the
 * first-level cache. Set by hand: with half of them the sums take a quarter longer, with a quarter of them two thirds.
 */
constexpr std::size_t FramesInRegisters = 8;

// As many frames as the block's 32-bit sums hold: |sum s| <= 2^15 2^15, and 2^14 pairs of squares' lower halves.
constexpr std::size_t FramesPerFlush = 32768;

struct BlockSums
{
  // They stay in the second-level cache while all frames pass by. A block is long enough for the processor to see,
  // within a frame, what it will be asked for next: shorter ones wait for the memory.
  static constexpr std::size_t Pixels = 4096;

  std::int32_t  sum[Pixels] = {};
  std::uint32_t low[Pixels] = {};  // sum of the lower 16 bits of the squares of two frames
  std::uint32_t high[Pixels] = {}; // and of the upper 16 bits: 32-bit sums vectorise, 64-bit ones hardly do
  std::int16_t  minimum[Pixels] = {};
  std::int16_t  maximum[Pixels] = {};
};

/** Adds as many pairs of frames as there are VPairs. Of the second frame of each what \a keep has: all bits, or none.
 */
template <std::int32_t VCentre, typename TPixel, std::size_t... VPairs>
void
AddPairs(const TPixel * first,
         std::size_t    stride,
         std::int32_t   keep,
         std::size_t    size,
         BlockSums &    block,
         std::index_sequence<VPairs...>)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    std::int32_t  sum = 0;
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::int16_t  minimum = block.minimum[i];
    std::int16_t  maximum = block.maximum[i];
    const auto    add = [&](std::size_t k) {
      const auto          a = static_cast<std::int16_t>(std::int32_t{ first[2 * k * stride + i] } - VCentre);
      const auto          b = static_cast<std::int16_t>(std::int32_t{ first[(2 * k + 1) * stride + i] } - VCentre);
      const auto          c = static_cast<std::int16_t>(b & keep);
      const std::uint32_t squares =
        static_cast<std::uint32_t>(std::int32_t{ a } * a) + static_cast<std::uint32_t>(std::int32_t{ c } * c);
      sum += std::int32_t{ a } + c;
      low += squares & 0xffffU;
      high += squares >> 16;
      minimum = std::min(minimum, std::min(a, b));
      maximum = std::max(maximum, std::max(a, b));
    };
    (add(VPairs), ...);
    block.sum[i] += sum;
    block.low[i] += low;
    block.high[i] += high;
    block.minimum[i] = minimum;
    block.maximum[i] = maximum;
  }
}

} // namespace

template <typename TPixel>
IntegerMoments<TPixel>::IntegerMoments(std::size_t pixels, const ParallelFor & parallelFor)
  : m_Sum(MakeMap<std::int64_t>(pixels, parallelFor))
  , m_SumOfSquares(MakeMap<std::uint64_t>(pixels, parallelFor))
  , m_Minimum(MakeMap(pixels, parallelFor, std::numeric_limits<std::int16_t>::max()))
  , m_Maximum(MakeMap(pixels, parallelFor, std::numeric_limits<std::int16_t>::min()))
{}

template <typename TPixel>
void
IntegerMoments<TPixel>::AddBlock(const TPixel *      firstFrame,
                                 const PixelLayout & layout,
                                 std::size_t         frames,
                                 std::size_t         begin,
                                 std::size_t         size,
                                 TPixel *            room)
{
  WithWideVectors([&] {
    BlockSums block;
    std::copy_n(m_Minimum.begin() + begin, size, block.minimum);
    std::copy_n(m_Maximum.begin() + begin, size, block.maximum);
    for (std::size_t t = 0; t < frames; t += FramesInRegisters)
    {
      const std::size_t now = std::min(FramesInRegisters, frames - t);
      const auto [first, stride] = layout.SideBySide(firstFrame + t * layout.frame, now, begin, begin + size, room);
      if (now == FramesInRegisters)
      {
        AddPairs<Centre>(first, stride, -1, size, block, std::make_index_sequence<FramesInRegisters / 2>());
        continue;
      }
      for (std::size_t k = 0; k < now; k += 2)
      {
        const bool isPaired = k + 1 < now; // an odd last frame is its own partner, of which nothing is added
        AddPairs<Centre>(
          first + k * stride, isPaired ? stride : 0, isPaired ? -1 : 0, size, block, std::index_sequence<0>());
      }
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      m_Sum[begin + i] += block.sum[i];
      m_SumOfSquares[begin + i] += block.low[i] + (std::uint64_t{ block.high[i] } << 16);
      m_Minimum[begin + i] = block.minimum[i];
      m_Maximum[begin + i] = block.maximum[i];
    }
  });
}

template <typename TPixel>
void
IntegerMoments<TPixel>::AddFrames(const TPixel *      firstFrame,
                                  const PixelLayout & layout,
                                  std::size_t         frames,
                                  std::size_t         begin,
                                  std::size_t         end)
{
  std::vector<TPixel> room(layout.AreSideBySide() ? 0 : FramesInRegisters * BlockSums::Pixels);
  for (std::size_t block = begin; block < end; block += BlockSums::Pixels)
  {
    const std::size_t size = std::min(BlockSums::Pixels, end - block);
    for (std::size_t t = 0; t < frames; t += FramesPerFlush)
    {
      this->AddBlock(
        firstFrame + t * layout.frame, layout, std::min(FramesPerFlush, frames - t), block, size, room.data());
    }
  }
}

template <typename TPixel>
void
IntegerMoments<TPixel>::Merge(const IntegerMoments & other)
{
  if (other.GetNumberOfPixels() != this->GetNumberOfPixels())
  {
    throw std::invalid_argument("moments of frames of " + std::to_string(other.GetNumberOfPixels()) +
                                " pixels cannot be merged into those of frames of " +
                                std::to_string(this->GetNumberOfPixels()) + " pixels");
  }
  for (std::size_t p = 0; p < m_Sum.size(); ++p)
  {
    m_Sum[p] += other.m_Sum[p];
    m_SumOfSquares[p] += other.m_SumOfSquares[p];
    m_Minimum[p] = std::min(m_Minimum[p], other.m_Minimum[p]);
    m_Maximum[p] = std::max(m_Maximum[p], other.m_Maximum[p]);
  }
  m_Frames += other.m_Frames;
}

template <typename TPixel>
void
IntegerMoments<TPixel>::Save(std::ostream & out) const
{
  WriteSumsHeader(out, IntegerStreamName<TPixel>(), m_Sum.size(), m_Frames);
  WriteNumbers(out, m_Sum);
  WriteNumbers(out, m_SumOfSquares);
  WriteNumbers(out, m_Minimum);
  WriteNumbers(out, m_Maximum);
}

template <typename TPixel>
void
IntegerMoments<TPixel>::Restore(std::istream & in)
{
  IntegerMoments read(m_Sum.size());
  read.m_Frames = ReadSumsHeader(in, IntegerStreamName<TPixel>(), m_Sum.size());
  ReadNumbers(in, read.m_Sum);
  ReadNumbers(in, read.m_SumOfSquares);
  ReadNumbers(in, read.m_Minimum);
  ReadNumbers(in, read.m_Maximum);
  *this = std::move(read);
}

template class IntegerMoments<unsigned char>;
template class IntegerMoments<signed char>;
template class IntegerMoments<unsigned short>;
template class IntegerMoments<short>;

} // namespace sensornoise
