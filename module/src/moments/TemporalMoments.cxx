// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/TemporalMoments.h"

#include "base/BinaryStream.h"
#include "base/ParallelWork.h"
#include "base/Simd.h"

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

/** Returns the name of the sums in a stream. */
template <typename TPixel>
std::string
IntegerStreamName()
{
  return "IntegerMoments 2 " + PixelName<TPixel>(); // 2: sums are doubles
}

/** Throws std::invalid_argument if sums over so many frames need not be exact. */
void
RequireExact(std::size_t frames, std::size_t most)
{
  if (frames > most)
  {
    throw std::invalid_argument("the stack has " + std::to_string(frames) + " frames; expected at most " +
                                std::to_string(most) + ", up to which sums are exact");
  }
}
} // namespace

namespace detail
{
/** Number of frames whose values are added in registers before they are added to the sums of a block, which need more
 * memory than the first-level cache has. Chosen empirically: with half of them the sums take a quarter longer, with a
 * quarter of them two thirds. */
constexpr std::size_t FramesInRegisters = 8;

// Largest number of frames that the signed 32-bit sums of a block hold: |sum s| <= 2^15 2^15, and 2^14 pairs of the
// lower halves of squares.
constexpr std::size_t FramesPerFlush = 32768;

struct BlockSums
{
  // Number of pixels of a block. The sums stay in the second-level cache while all frames are added. The block is long
  // enough for the processor to prefetch within a frame; with shorter blocks it waits for the memory.
  static constexpr std::size_t Pixels = 4096;

  std::int32_t  sum[Pixels] = {};
  std::uint32_t low[Pixels] = {};  // sum of the lower 16 bits of the squares of two frames
  std::uint32_t high[Pixels] = {}; // sum of the upper 16 bits: 32-bit sums vectorise, 64-bit ones hardly do
  std::int16_t  minimum[Pixels] = {};
  std::int16_t  maximum[Pixels] = {};
};

/** Adds as many pairs of frames as there are VPairs, of every VStep-th value, to the sums from \a offset on. The second
 * frame of each pair is masked by \a keep: all bits, or none. */
template <std::int32_t VCentre, std::size_t VStep, typename TPixel, std::size_t... VPairs>
void
AddPairs(const TPixel * first,
         std::size_t    stride,
         std::int32_t   keep,
         std::size_t    size,
         std::size_t    offset,
         BlockSums &    block,
         std::index_sequence<VPairs...>)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    std::int32_t  sum = 0;
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::int16_t  minimum = block.minimum[offset + i];
    std::int16_t  maximum = block.maximum[offset + i];
    const auto    add = [&](std::size_t k) {
      const auto a = static_cast<std::int16_t>(std::int32_t{ first[2 * k * stride + VStep * i] } - VCentre);
      const auto b = static_cast<std::int16_t>(std::int32_t{ first[(2 * k + 1) * stride + VStep * i] } - VCentre);
      const auto c = static_cast<std::int16_t>(b & keep);
      const std::uint32_t squares =
        static_cast<std::uint32_t>(std::int32_t{ a } * a) + static_cast<std::uint32_t>(std::int32_t{ c } * c);
      sum += std::int32_t{ a } + c;
      low += squares & 0xffffU;
      high += squares >> 16;
      minimum = std::min(minimum, std::min(a, b));
      maximum = std::max(maximum, std::max(a, b));
    };
    (add(VPairs), ...);
    block.sum[offset + i] += sum;
    block.low[offset + i] += low;
    block.high[offset + i] += high;
    block.minimum[offset + i] = minimum;
    block.maximum[offset + i] = maximum;
  }
}

/** Adds \a frames frames to the sums from \a offset on. The values of the first frame begin at \a first. */
template <std::int32_t VCentre, std::size_t VStep, typename TPixel>
void
AddRun(const TPixel * first,
       std::size_t    stride,
       std::size_t    frames,
       std::size_t    size,
       std::size_t    offset,
       BlockSums &    block)
{
  std::size_t t = 0;
  for (; t + FramesInRegisters <= frames; t += FramesInRegisters)
  {
    AddPairs<VCentre, VStep>(
      first + t * stride, stride, -1, size, offset, block, std::make_index_sequence<FramesInRegisters / 2>());
  }
  for (; t < frames; t += 2)
  {
    const bool isPaired = t + 1 < frames; // an odd last frame is paired with itself, masked to 0
    AddPairs<VCentre, VStep>(
      first + t * stride, isPaired ? stride : 0, isPaired ? -1 : 0, size, offset, block, std::index_sequence<0>());
  }
}

} // namespace detail

template <typename TPixel>
IntegerMoments<TPixel>::IntegerMoments(std::size_t pixels, const ParallelFor & parallelFor)
  : m_Sum(MakeMap<double>(pixels, parallelFor))
  , m_SumOfSquares(MakeMap<double>(pixels, parallelFor))
  , m_Minimum(MakeMap(pixels, parallelFor, std::numeric_limits<std::int16_t>::max()))
  , m_Maximum(MakeMap(pixels, parallelFor, std::numeric_limits<std::int16_t>::min()))
{}

template <typename TPixel>
void
IntegerMoments<TPixel>::AddBlock(const TPixel *      firstFrame,
                                 const PixelLayout & layout,
                                 std::size_t         frames,
                                 std::size_t         begin,
                                 std::size_t         size)
{
  CallWithAvx2([&] {
    detail::BlockSums block;
    std::copy_n(m_Minimum.begin() + begin, size, block.minimum);
    std::copy_n(m_Maximum.begin() + begin, size, block.maximum);
    layout.ForRuns(begin, begin + size, [&](std::size_t p, std::size_t place, std::size_t count) {
      const TPixel * const first = firstFrame + place;
      layout.step == 1 ? detail::AddRun<Centre, 1>(first, layout.frame, frames, count, p - begin, block)
                       : detail::AddRun<Centre, 2>(first, layout.frame, frames, count, p - begin, block);
    });
    for (std::size_t i = 0; i < size; ++i)
    {
      m_Sum[begin + i] += block.sum[i];
      // As signed numbers, which they fit: their conversion is a single instruction.
      m_SumOfSquares[begin + i] +=
        static_cast<std::int32_t>(block.low[i]) + 65536.0 * static_cast<std::int32_t>(block.high[i]);
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
  for (std::size_t block = begin; block < end; block += detail::BlockSums::Pixels)
  {
    const std::size_t size = std::min(detail::BlockSums::Pixels, end - block);
    for (std::size_t t = 0; t < frames; t += detail::FramesPerFlush)
    {
      this->AddBlock(firstFrame + t * layout.frame, layout, std::min(detail::FramesPerFlush, frames - t), block, size);
    }
  }
}

template <typename TPixel>
void
IntegerMoments<TPixel>::AdvanceFrames(std::size_t frames)
{
  RequireExact(m_Frames + frames, MostFrames);
  m_Frames += frames;
}

template <typename TPixel>
TemporalMaps<TPixel>
IntegerMoments<TPixel>::TakeMaps(const ParallelFor & parallelFor)
{
  ForBlocks(m_Sum.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    CallWithAvx2([&] {
      for (std::size_t p = begin; p < end; ++p)
      {
        const double mean = this->GetMean(p);
        m_SumOfSquares[p] = m_Frames > 1 ? this->GetVariance(p) : 0.0;
        m_Sum[p] = mean;
      }
    });
  });
  m_Frames = 0;
  return { std::move(m_Sum), std::move(m_SumOfSquares), std::move(m_Minimum), std::move(m_Maximum) };
}

template <typename TPixel>
void
IntegerMoments<TPixel>::Merge(const IntegerMoments & other)
{
  if (other.GetNumberOfPixels() != this->GetNumberOfPixels())
  {
    throw std::invalid_argument("moments of frames of " + std::to_string(other.GetNumberOfPixels()) +
                                " pixels cannot be merged into moments of frames of " +
                                std::to_string(this->GetNumberOfPixels()) + " pixels");
  }
  RequireExact(m_Frames + other.m_Frames, MostFrames);
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

namespace
{

/** Returns the name of the sums in a stream. */
template <typename TPixel>
std::string
FloatingStreamName()
{
  return "FloatingMoments " + PixelName<TPixel>();
}

} // namespace

template <typename TPixel>
FloatingMoments<TPixel>::FloatingMoments(std::size_t pixels, const ParallelFor & parallelFor)
  : m_Mean(MakeMap<double>(pixels, parallelFor))
  , m_Squares(MakeMap<double>(pixels, parallelFor))
  , m_Minimum(MakeMap(pixels, parallelFor, std::numeric_limits<double>::infinity()))
  , m_Maximum(MakeMap(pixels, parallelFor, -std::numeric_limits<double>::infinity()))
{}

template <typename TPixel>
void
FloatingMoments<TPixel>::AddFrames(const TPixel *      firstFrame,
                                   const PixelLayout & layout,
                                   std::size_t         frames,
                                   std::size_t         begin,
                                   std::size_t         end)
{
  constexpr std::size_t blockSize = 512; // the sums of a block stay in the first-level cache
  TPixel                buffer[blockSize];
  for (std::size_t block = begin; block < end; block += blockSize)
  {
    const std::size_t blockEnd = std::min(block + blockSize, end);
    for (std::size_t t = 0; t < frames; ++t)
    {
      const TPixel * const values = layout.SideBySide(firstFrame + t * layout.frame, block, blockEnd, buffer);
      const double         fraction = 1.0 / static_cast<double>(m_Frames + t + 1);
      for (std::size_t p = block; p < blockEnd; ++p)
      {
        const double value = values[p - block];
        const double deviation = value - m_Mean[p];
        m_Mean[p] += deviation * fraction;
        m_Squares[p] += deviation * (value - m_Mean[p]);
        m_Minimum[p] = value < m_Minimum[p] ? value : m_Minimum[p];
        m_Maximum[p] = value > m_Maximum[p] ? value : m_Maximum[p];
      }
    }
  }
}

template <typename TPixel>
TemporalMaps<TPixel>
FloatingMoments<TPixel>::TakeMaps(const ParallelFor & parallelFor)
{
  ForBlocks(m_Mean.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_Mean[p] = this->GetMean(p);
      m_Squares[p] = m_Frames > 1 ? this->GetVariance(p) : 0.0 * m_Mean[p]; // NaN where the pixel is not finite
    }
  });
  m_Frames = 0;
  return { std::move(m_Mean), std::move(m_Squares), std::move(m_Minimum), std::move(m_Maximum) };
}

template <typename TPixel>
void
FloatingMoments<TPixel>::Merge(const FloatingMoments & later)
{
  if (later.GetNumberOfPixels() != this->GetNumberOfPixels())
  {
    throw std::invalid_argument("moments of frames of " + std::to_string(later.GetNumberOfPixels()) +
                                " pixels cannot be merged into moments of frames of " +
                                std::to_string(this->GetNumberOfPixels()) + " pixels");
  }
  const std::size_t frames = m_Frames + later.m_Frames;
  if (later.m_Frames == 0)
  {
    return;
  }
  const double fraction = static_cast<double>(later.m_Frames) / static_cast<double>(frames);
  const double weight = static_cast<double>(m_Frames) * fraction;
  for (std::size_t p = 0; p < m_Mean.size(); ++p)
  {
    const double deviation = later.m_Mean[p] - m_Mean[p];
    m_Mean[p] += deviation * fraction;
    m_Squares[p] += later.m_Squares[p] + deviation * deviation * weight;
    m_Minimum[p] = std::min(m_Minimum[p], later.m_Minimum[p]);
    m_Maximum[p] = std::max(m_Maximum[p], later.m_Maximum[p]);
  }
  m_Frames = frames;
}

template <typename TPixel>
void
FloatingMoments<TPixel>::Save(std::ostream & out) const
{
  WriteSumsHeader(out, FloatingStreamName<TPixel>(), m_Mean.size(), m_Frames);
  WriteNumbers(out, m_Mean);
  WriteNumbers(out, m_Squares);
  WriteNumbers(out, m_Minimum);
  WriteNumbers(out, m_Maximum);
}

template <typename TPixel>
void
FloatingMoments<TPixel>::Restore(std::istream & in)
{
  FloatingMoments read(m_Mean.size());
  read.m_Frames = ReadSumsHeader(in, FloatingStreamName<TPixel>(), m_Mean.size());
  ReadNumbers(in, read.m_Mean);
  ReadNumbers(in, read.m_Squares);
  ReadNumbers(in, read.m_Minimum);
  ReadNumbers(in, read.m_Maximum);
  *this = std::move(read);
}

template class FloatingMoments<float>;
template class FloatingMoments<double>;

} // namespace sensornoise
