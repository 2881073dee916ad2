// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/IntegerMoments.h"

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/FirstTouch.h"

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
IntegerMoments<TPixel>::AddBlock(const TPixel * first,
                                 std::size_t    stride,
                                 std::size_t    frames,
                                 std::size_t    block,
                                 std::size_t    size)
{
  std::int32_t  sum[BlockSize] = {};
  std::uint32_t low[BlockSize] = {};  // sum of the lower 16 bits of the squares of two frames
  std::uint32_t high[BlockSize] = {}; // and of the upper 16 bits: 32-bit sums vectorise, 64-bit ones hardly do
  std::int16_t  minimum[BlockSize];
  std::int16_t  maximum[BlockSize];
  std::copy_n(m_Minimum.begin() + block, size, minimum);
  std::copy_n(m_Maximum.begin() + block, size, maximum);

  for (std::size_t t = 0; t < frames; t += 2)
  {
    const TPixel * const f0 = first + t * stride;
    const bool           paired = t + 1 < frames;
    const TPixel * const f1 = paired ? f0 + stride : f0;
    const std::int32_t   keep = paired ? -1 : 0; // an odd last frame is paired with zeros
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::int16_t  a = Shifted(f0[i]);
      const std::int16_t  b = Shifted(f1[i]);
      const auto          c = static_cast<std::int16_t>(b & keep);
      const std::uint32_t squares =
        static_cast<std::uint32_t>(std::int32_t{ a } * a) + static_cast<std::uint32_t>(std::int32_t{ c } * c);
      sum[i] += std::int32_t{ a } + c;
      low[i] += squares & 0xffffU;
      high[i] += squares >> 16;
      minimum[i] = std::min(minimum[i], std::min(a, b));
      maximum[i] = std::max(maximum[i], std::max(a, b));
    }
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    m_Sum[block + i] += sum[i];
    m_SumOfSquares[block + i] += low[i] + (std::uint64_t{ high[i] } << 16);
    m_Minimum[block + i] = minimum[i];
    m_Maximum[block + i] = maximum[i];
  }
}

template <typename TPixel>
void
IntegerMoments<TPixel>::AddFrames(const TPixel * firstFrame,
                                  std::size_t    stride,
                                  std::size_t    frames,
                                  std::size_t    begin,
                                  std::size_t    end)
{
  for (std::size_t block = begin; block < end; block += BlockSize)
  {
    const std::size_t size = std::min(BlockSize, end - block);
    for (std::size_t t = 0; t < frames; t += FramesPerFlush)
    {
      this->AddBlock(firstFrame + t * stride + block, stride, std::min(FramesPerFlush, frames - t), block, size);
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
