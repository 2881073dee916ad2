// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/StackMoments.h"

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/BytesFingerprint.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/WideVectors.h"
#include "sensornoise/moments/ChosenFrames.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <numeric>
#include <ostream>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{

/** Sum of the finite ones of \a count pixels, at most those of a block of fingerprints: 32 bits hold that of integers.
 */
template <typename TPixel>
double
SumOfPixels(const TPixel * pixels, std::size_t count)
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    static_assert(FingerprintBlockBytes <= 32768 && sizeof(TPixel) <= 2);
    std::int32_t sum = 0;
    WithWideVectors([&] {
      for (std::size_t i = 0; i < count; ++i)
      {
        sum += pixels[i];
      }
    });
    return sum;
  }
  else
  {
    return std::accumulate(pixels, pixels + count, 0.0, [](double sum, TPixel value) {
      return std::isfinite(value) ? sum + static_cast<double>(value) : sum;
    });
  }
}

/** A frame's bytes pass the cache once for its mean and its fingerprint. */
template <typename TPixel>
std::vector<BytesFingerprint>
FindMeansAndFingerprints(const TPixel *      frames,
                         std::size_t         pixels,
                         std::size_t         count,
                         const ParallelFor & parallelFor,
                         double *            means)
{
  constexpr std::size_t         pixelsOfBlock = FingerprintBlockBytes / sizeof(TPixel);
  const std::size_t             blocks = (pixels + pixelsOfBlock - 1) / pixelsOfBlock;
  std::vector<double>           sums(count * blocks);
  std::vector<BytesFingerprint> fingerprints =
    FingerprintsOf(frames,
                   pixels * sizeof(TPixel),
                   count,
                   parallelFor,
                   [&](std::size_t k, std::size_t block, std::size_t firstByte, std::size_t bytes) {
                     sums[k * blocks + block] =
                       SumOfPixels(frames + k * pixels + firstByte / sizeof(TPixel), bytes / sizeof(TPixel));
                   });
  for (std::size_t k = 0; k < count; ++k)
  {
    const double * const first = sums.data() + k * blocks;
    means[k] = std::accumulate(first, first + blocks, 0.0) / static_cast<double>(pixels);
  }
  return fingerprints;
}

} // namespace

template <typename TPixel>
StackMoments<TPixel>::StackMoments(std::size_t pixels, std::size_t frames, const ParallelFor & parallelFor)
  : m_Pixels(pixels)
  , m_FrameMeans(frames, 0.0)
  , m_Fingerprints(frames)
  , m_Own(pixels, parallelFor)
{}

template <typename TPixel>
void
StackMoments<TPixel>::AddFrames(const TPixel *      frames,
                                std::size_t         first,
                                std::size_t         count,
                                const ParallelFor & parallelFor)
{
  m_First = std::min(m_First, first);
  const std::vector<std::uint8_t> isNew = m_Fingerprints.Add(
    first, FindMeansAndFingerprints(frames, m_Pixels, count, parallelFor, m_FrameMeans.data() + first));
  ForChosenFrames(frames, m_Pixels, isNew, parallelFor, [&](const TPixel * chosen, std::size_t number) {
    ForBlocks(m_Pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
      m_Own.AddFrames(chosen, m_Pixels, number, begin, end);
    });
    m_Own.AdvanceFrames(number);
  });
}

template <typename TPixel>
void
StackMoments<TPixel>::Save(std::ostream & out) const
{
  WriteNumbers(out, m_FrameMeans);
  m_Fingerprints.Save(out);
  WriteCount(out, m_Others.size() + 1);
  WriteCount(out, m_First);
  m_Own.Save(out);
  for (const auto & [first, moments] : m_Others)
  {
    WriteCount(out, first);
    moments.Save(out);
  }
}

template <typename TPixel>
void
StackMoments<TPixel>::Merge(std::istream & in)
{
  std::vector<double> frameMeans(m_FrameMeans.size());
  ReadNumbers(in, frameMeans);
  const FrameFingerprints                        fingerprints = m_Fingerprints.ReadOther(in);
  std::map<std::size_t, TemporalMoments<TPixel>> parts;
  for (std::uint64_t count = ReadCount(in); count > 0; --count)
  {
    const std::size_t first = ReadCount(in);
    parts.try_emplace(first, m_Pixels).first->second.Restore(in);
  }
  m_Fingerprints.RequireApart(fingerprints);
  m_Fingerprints.Merge(fingerprints);
  for (auto & [first, moments] : parts)
  {
    if constexpr (std::is_integral_v<TPixel>)
    {
      m_Own.Merge(moments);
      m_First = std::min(m_First, first);
    }
    else if (moments.GetNumberOfFrames() > 0)
    {
      m_Others.emplace(first, std::move(moments));
    }
  }
  std::transform(frameMeans.begin(), frameMeans.end(), m_FrameMeans.begin(), m_FrameMeans.begin(), std::plus<double>());
}

template <typename TPixel>
void
StackMoments<TPixel>::Fold()
{
  if (!m_Others.empty())
  {
    const std::size_t first = std::min(m_First, m_Others.begin()->first);
    m_Own = this->Take();
    m_First = first;
  }
}

template <typename TPixel>
TemporalMoments<TPixel>
StackMoments<TPixel>::Take()
{
  if (m_Others.empty())
  {
    return std::exchange(m_Own, TemporalMoments<TPixel>(0));
  }
  if (m_Own.GetNumberOfFrames() > 0)
  {
    m_Others.emplace(m_First, std::exchange(m_Own, TemporalMoments<TPixel>(0)));
  }
  TemporalMoments<TPixel> whole(m_Pixels);
  for (const auto & part : m_Others)
  {
    whole.Merge(part.second);
  }
  m_Others.clear();
  return whole;
}

template class StackMoments<unsigned char>;
template class StackMoments<unsigned short>;
template class StackMoments<short>;
template class StackMoments<float>;
template class StackMoments<double>;

} // namespace sensornoise
