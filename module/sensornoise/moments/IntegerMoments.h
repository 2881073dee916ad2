/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_moments_IntegerMoments_h
#define sensornoise_moments_IntegerMoments_h

#include "sensornoise/base/BinaryStream.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class IntegerMoments
 * \brief Exact sums over time of every pixel of a stack of 8- or 16-bit frames: mean, variance, minimum, maximum.
 *
 * Each value u [DN] is held as s = u - centre, which fits a signed 16-bit number, and the sums S = sum s and
 * Q = sum s^2 are exact integers. So frames may be added, and parts merged, in any order and in any number of
 * threads: the result has the same bits. The variance is unbiased (section 2.3.1 of Sur & Gredi\'ac 2015,
 * https://doi.org/10.1137/140977035) and its subtraction is done in integers.
 *
 * Usage: for each run of frames, call AddFrames() for ranges of pixels that cover the frame once (ranges may be added
 * at the same time by different threads), then AdvanceFrames() once.
 *
 * Memory: 20 bytes a pixel, whatever the number of frames. Up to 2^31 frames.
 *
 * \tparam TPixel unsigned char, signed char, unsigned short or short.
 */
template <typename TPixel>
class IntegerMoments
{
  static_assert(std::is_integral_v<TPixel> && sizeof(TPixel) <= 2, "IntegerMoments holds 8- and 16-bit pixels");

public:
  explicit IntegerMoments(std::size_t pixels = 0)
    : m_Sum(pixels, 0)
    , m_SumOfSquares(pixels, 0)
    , m_Minimum(pixels, std::numeric_limits<std::int16_t>::max())
    , m_Maximum(pixels, std::numeric_limits<std::int16_t>::min())
  {}

  /** Adds \a frames frames for the pixels [begin, end). \a firstFrame points at pixel 0 of the first frame, and each
   * next frame begins \a stride pixels later. */
  void
  AddFrames(const TPixel * firstFrame, std::size_t stride, std::size_t frames, std::size_t begin, std::size_t end)
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

  /** Tells that \a frames frames have been added for every pixel. */
  void
  AdvanceFrames(std::size_t frames)
  {
    m_Frames += frames;
  }

  /** Adds the sums of other frames of the same pixels: exact, in any order. */
  void
  Merge(const IntegerMoments & other)
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

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const
  {
    WriteSumsHeader(out, StreamName(), m_Sum.size(), m_Frames);
    WriteNumbers(out, m_Sum);
    WriteNumbers(out, m_SumOfSquares);
    WriteNumbers(out, m_Minimum);
    WriteNumbers(out, m_Maximum);
  }

  /** Replaces the sums by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums, or
   * those of another type or number of pixels, or ends early. */
  void
  Restore(std::istream & in)
  {
    IntegerMoments read(m_Sum.size());
    read.m_Frames = ReadSumsHeader(in, StreamName(), m_Sum.size());
    ReadNumbers(in, read.m_Sum);
    ReadNumbers(in, read.m_SumOfSquares);
    ReadNumbers(in, read.m_Minimum);
    ReadNumbers(in, read.m_Maximum);
    *this = std::move(read);
  }

  std::size_t
  GetNumberOfPixels() const
  {
    return m_Sum.size();
  }
  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** Integers are always finite. */
  bool
  IsFinite(std::size_t) const
  {
    return true;
  }

  /** Mean of pixel \a p over time [DN]. */
  double
  GetMean(std::size_t p) const
  {
    return static_cast<double>(m_Sum[p]) / static_cast<double>(m_Frames) + Centre;
  }

  /** Sum of the squared deviations of pixel \a p from its mean [DN^2].
   *
   * With S = q n + r, the sum about the integer q is A = Q - q (S + r), exact; about the mean it is A - r^2/n. */
  double
  GetSumOfSquaredDeviations(std::size_t p) const
  {
    const auto         n = static_cast<std::int64_t>(m_Frames);
    const std::int64_t q = m_Sum[p] / n;
    const std::int64_t r = m_Sum[p] - q * n;
    const std::int64_t aboutQ = static_cast<std::int64_t>(m_SumOfSquares[p]) - q * (m_Sum[p] + r);
    return static_cast<double>(aboutQ) - static_cast<double>(r) * static_cast<double>(r) / static_cast<double>(n);
  }

  /** Unbiased variance of pixel \a p over time [DN^2]; needs two frames. */
  double
  GetVariance(std::size_t p) const
  {
    return this->GetSumOfSquaredDeviations(p) / static_cast<double>(m_Frames - 1);
  }

  /** Lowest and highest value of pixel \a p over time [DN]. */
  double
  GetMinimum(std::size_t p) const
  {
    return m_Minimum[p] + Centre;
  }
  double
  GetMaximum(std::size_t p) const
  {
    return m_Maximum[p] + Centre;
  }

private:
  // Only unsigned 16-bit values need to be shifted to fit a signed 16-bit number.
  static constexpr std::int32_t Centre = std::is_unsigned_v<TPixel> && sizeof(TPixel) == 2 ? 32768 : 0;

  // A block's sums stay in the first-level cache while all frames pass by.
  static constexpr std::size_t BlockSize = 1024;

  // As many frames as the block's 32-bit sums hold: |sum s| <= 2^15 2^15, and 2^14 pairs of squares' lower halves.
  static constexpr std::size_t FramesPerFlush = 32768;

  static std::string
  StreamName()
  {
    return "IntegerMoments " + PixelName<TPixel>();
  }

  static std::int16_t
  Shifted(TPixel value)
  {
    return static_cast<std::int16_t>(static_cast<std::int32_t>(value) - Centre);
  }

  void
  AddBlock(const TPixel * first, std::size_t stride, std::size_t frames, std::size_t block, std::size_t size)
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

  std::size_t                m_Frames{ 0 };
  std::vector<std::int64_t>  m_Sum;
  std::vector<std::uint64_t> m_SumOfSquares;
  std::vector<std::int16_t>  m_Minimum;
  std::vector<std::int16_t>  m_Maximum;
};

} // namespace sensornoise

#endif
