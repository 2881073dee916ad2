// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMoments.h"

#include "base/BinaryStream.h"
#include "base/BytesFingerprint.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Simd.h"
#include "moments/StackFrames.h"
#include "moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

FrameFingerprints::FrameFingerprints(std::size_t frames)
  : m_Frames(frames)
{}

void
FrameFingerprints::SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
{
  if (areCountedElsewhere.size() != m_Frames)
  {
    throw std::invalid_argument("of " + std::to_string(areCountedElsewhere.size()) +
                                " frames it is said whether they are counted elsewhere; expected " +
                                std::to_string(m_Frames));
  }
  m_CountedElsewhere = areCountedElsewhere;
}

void
FrameFingerprints::TakeUp(std::size_t t, const BytesFingerprint & fingerprint, bool isCounted)
{
  m_OfFrame[t] = fingerprint;
  Equal & equal = m_Equal.try_emplace(fingerprint, Equal{ t, false }).first->second;
  equal.first = std::min(equal.first, t);
  equal.isCounted = equal.isCounted || isCounted;
}

std::vector<std::uint8_t>
FrameFingerprints::Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints)
{
  std::vector<std::uint8_t> isNew(fingerprints.size());
  for (std::size_t k = 0; k < fingerprints.size(); ++k)
  {
    const auto equal = m_Equal.find(fingerprints[k]);
    const bool isCounted = equal != m_Equal.end() && equal->second.isCounted;
    const bool isElsewhere = !m_CountedElsewhere.empty() && m_CountedElsewhere[first + k] != 0;
    isNew[k] = isCounted || isElsewhere ? 0 : 1;
    this->TakeUp(first + k, fingerprints[k], isNew[k] != 0);
  }
  return isNew;
}

void
FrameFingerprints::RequireApart(const FrameFingerprints & other) const
{
  for (const auto & [fingerprint, equal] : m_Equal)
  {
    const auto others = other.m_Equal.find(fingerprint);
    if (equal.isCounted && others != other.m_Equal.end() && others->second.isCounted)
    {
      const auto [first, second] = std::minmax(equal.first, others->second.first);
      throw std::runtime_error("sums cannot be merged: frame " + std::to_string(second) + " equals frame " +
                               std::to_string(first) +
                               ", and each was counted by another process; let one process read both, or merge the "
                               "sums of one before the other adds its frames");
    }
  }
}

void
FrameFingerprints::Merge(const FrameFingerprints & other)
{
  for (const auto & [t, fingerprint] : other.m_OfFrame)
  {
    this->TakeUp(t, fingerprint, other.m_Equal.at(fingerprint).isCounted);
  }
}

void
FrameFingerprints::Save(std::ostream & out) const
{
  WriteCount(out, m_OfFrame.size());
  for (const auto & [t, fingerprint] : m_OfFrame)
  {
    WriteCount(out, t);
    WriteNumbers(out, fingerprint.data(), fingerprint.size());
    WriteCount(out, m_Equal.at(fingerprint).isCounted ? 1 : 0);
  }
}

FrameFingerprints
FrameFingerprints::ReadOther(std::istream & in) const
{
  FrameFingerprints other(m_Frames);
  for (std::uint64_t count = ReadCount(in); count > 0; --count)
  {
    const std::uint64_t t = ReadCount(in);
    BytesFingerprint    fingerprint{};
    ReadNumbers(in, fingerprint.data(), fingerprint.size());
    const bool isCounted = ReadCount(in) != 0;
    if (t >= m_Frames)
    {
      throw std::runtime_error("the sums of a stream do not fit: found frame " + std::to_string(t) + " of " +
                               std::to_string(m_Frames));
    }
    other.TakeUp(t, fingerprint, isCounted);
  }
  return other;
}

DistinctFrames
FrameFingerprints::FindDistinct() const
{
  std::vector<std::size_t> originals(m_Frames);
  for (std::size_t t = 0; t < m_Frames; ++t)
  {
    const auto found = m_OfFrame.find(t);
    if (found == m_OfFrame.end())
    {
      originals[t] = t;
      continue;
    }
    const Equal & equal = m_Equal.at(found->second);
    if (!equal.isCounted)
    {
      throw std::logic_error("frame " + std::to_string(t) + " was left to another process, and none counted it");
    }
    originals[t] = equal.first;
  }
  return DistinctFrames(std::move(originals));
}

namespace
{

/** Sum of some pixels, and their number. */
struct PixelSum
{
  double sum{ 0.0 };
  double pixels{ 0.0 };

  PixelSum &
  operator+=(const PixelSum & other)
  {
    sum += other.sum;
    pixels += other.pixels;
    return *this;
  }
};

/** Returns the sum of the pixels that are finite, and nonzero in \a mask if that is not null, among \a count pixels, at
 * most a block of fingerprints: 32 bits hold the sum of its integers. */
template <typename TPixel>
PixelSum
SumOfPixels(const TPixel * pixels, const std::uint8_t * mask, std::size_t count)
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    if (mask == nullptr)
    {
      static_assert(FingerprintBlockBytes <= 32768 && sizeof(TPixel) <= 2);
      std::int32_t sum = 0;
      CallWithAvx2([&] {
        for (std::size_t i = 0; i < count; ++i)
        {
          sum += pixels[i];
        }
      });
      return { static_cast<double>(sum), static_cast<double>(count) };
    }
  }
  PixelSum all;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto value = static_cast<double>(pixels[i]);
    if (std::isfinite(value) && (mask == nullptr || mask[i] != 0))
    {
      all += { value, 1.0 };
    }
  }
  return all;
}

/** Mean and fingerprint of a frame of a plane. */
struct MeanAndFingerprint
{
  double           mean;
  BytesFingerprint fingerprint;
};

/** Computes the mean and the fingerprint of every frame of every plane. The order is by plane, then by frame. Each
 * pixel is loaded into the cache once. */
template <typename TPixel>
std::vector<MeanAndFingerprint>
FindMeansAndFingerprints(const std::vector<typename StackMoments<TPixel>::Plane> & planes,
                         std::size_t                                               pixels,
                         const TPixel *                                            frames,
                         std::size_t                                               count,
                         const ParallelFor &                                       parallelFor)
{
  constexpr std::size_t         blockPixels = FingerprintBlockBytes / sizeof(TPixel);
  const std::size_t             blocks = NumberOfFingerprintBlocks(pixels * sizeof(TPixel));
  std::vector<PixelSum>         sums(planes.size() * count * blocks);
  std::vector<BytesFingerprint> fingerprints(sums.size());
  parallelFor(count * blocks, [&](std::size_t i) {
    std::vector<TPixel> buffer(planes.front().layout.AreSideBySide() ? 0 : blockPixels);
    const std::size_t   begin = i % blocks * blockPixels;
    const std::size_t   end = std::min(pixels, begin + blockPixels);
    for (std::size_t plane = 0; plane < planes.size(); ++plane)
    {
      const PixelLayout &        layout = planes[plane].layout;
      const std::uint8_t * const mask = planes[plane].mask;
      const TPixel * const block = layout.SideBySide(frames + i / blocks * layout.frame, begin, end, buffer.data());
      fingerprints[plane * count * blocks + i] = FingerprintOfBlock(block, (end - begin) * sizeof(TPixel));
      sums[plane * count * blocks + i] = SumOfPixels(block, mask == nullptr ? mask : mask + begin, end - begin);
    }
  });
  std::vector<MeanAndFingerprint> found;
  for (std::size_t i = 0; i < sums.size(); i += blocks)
  {
    const BytesFingerprint * const block = fingerprints.data() + i;
    PixelSum                       all;
    for (std::size_t b = 0; b < blocks; ++b)
    {
      all += sums[i + b];
    }
    found.push_back({ all.sum / std::max(1.0, all.pixels), FingerprintOfBlocks(block, block + blocks) });
  }
  return found;
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
StackMoments<TPixel>::AddFrames(const std::vector<Plane> & planes,
                                const TPixel *             frames,
                                std::size_t                first,
                                std::size_t                count,
                                const ParallelFor &        parallelFor)
{
  const std::size_t  pixels = planes.front().moments->m_Pixels;
  const auto         found = FindMeansAndFingerprints(planes, pixels, frames, count, parallelFor);
  std::vector<Plane> together;
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    StackMoments &                own = *planes[i].moments;
    std::vector<BytesFingerprint> fingerprints;
    for (std::size_t k = 0; k < count; ++k)
    {
      own.m_FrameMeans[first + k] = found[i * count + k].mean;
      fingerprints.push_back(found[i * count + k].fingerprint);
    }
    own.m_First = std::min(own.m_First, first);
    const std::vector<std::uint8_t> isNew = own.m_Fingerprints.Add(first, fingerprints);
    if (std::find(isNew.begin(), isNew.end(), std::uint8_t{ 0 }) == isNew.end())
    {
      together.push_back(planes[i]);
      continue;
    }
    ForChosenFrames(frames, planes[i].layout.frame, isNew, parallelFor, [&](const TPixel * chosen, std::size_t number) {
      AddDistinct({ planes[i] }, chosen, number, parallelFor);
    });
  }
  AddDistinct(together, frames, count, parallelFor);
}

template <typename TPixel>
void
StackMoments<TPixel>::AddDistinct(const std::vector<Plane> & planes,
                                  const TPixel *             frames,
                                  std::size_t                count,
                                  const ParallelFor &        parallelFor)
{
  const std::size_t pixels = planes.empty() ? 0 : planes.front().moments->m_Pixels;
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (const Plane & plane : planes)
    {
      plane.moments->m_Own.AddFrames(frames, plane.layout, count, begin, end);
    }
  });
  for (const Plane & plane : planes)
  {
    plane.moments->m_Own.AdvanceFrames(count);
  }
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

#define SensorNoise_INSTANTIATE(TPixel) template class StackMoments<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
