// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ProjectionSums.h"

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/PairProducts.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr const char * Name = "ProjectionSums";

/** Frames of integers that are added together. */
constexpr std::size_t MostTogether = 2 * FramePairs::MostPairs;
static_assert(ProjectionSums::BlockPixels == FramePairs::MostPixels);

/** What is taken off a value, so that 16 bits with a sign hold it. */
template <typename TPixel>
constexpr int Middle = std::is_same_v<TPixel, unsigned short> ? 32768 : 0;

/** What the frames of a series are multiplied by. */
struct SeriesWeights
{
  std::vector<PairWeights> pairs;
  double                   ofMiddle{ 0.0 }; // what was taken off all values, times the weights
};

template <typename TPixel>
SeriesWeights
WeightsOf(const TemporalBasis & basis, std::size_t series, std::size_t firstFrame, std::size_t count)
{
  SeriesWeights weights;
  for (std::size_t t = 0; t < count; t += 2)
  {
    const double first = basis.Rounded(firstFrame + t, series);
    const double second = t + 1 < count ? basis.Rounded(firstFrame + t + 1, series) : 0.0;
    weights.pairs.emplace_back(first, second);
    weights.ofMiddle += Middle<TPixel> * (first + second);
  }
  return weights;
}

/** Takes the values of \a pixels pixels; where their number is odd, the last frame is its own partner. */
template <typename TPixel>
void
TakePairs(const TPixel * frames, std::size_t stride, std::size_t count, std::size_t pixels, FramePairs & pairs)
{
  for (std::size_t k = 0; 2 * k < count; ++k)
  {
    const TPixel * first = frames + 2 * k * stride;
    const TPixel * second = 2 * k + 1 < count ? first + stride : first;
    std::int16_t * pair = pairs.values[k];
    for (std::size_t i = 0; i < pixels; ++i)
    {
      pair[2 * i] = static_cast<std::int16_t>(first[i] - Middle<TPixel>);
      pair[2 * i + 1] = static_cast<std::int16_t>(second[i] - Middle<TPixel>);
    }
    std::fill(pair + 2 * pixels, pair + 2 * FramePairs::Padded(pixels), std::int16_t{ 0 });
  }
}
} // namespace

ProjectionSums::ProjectionSums(std::size_t         pixels,
                               std::size_t         series,
                               const ParallelFor & parallelFor,
                               std::size_t         firstSlab,
                               std::size_t         lastSlab)
  : m_Pixels(pixels)
  , m_Series(series)
  , m_FirstSlab(firstSlab)
  , m_LastSlab(std::min(lastSlab, NumberOfSlabs(pixels)))
  , m_Slabs(NumberOfSlabs(pixels))
{
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    const std::size_t own = std::min(SlabPixels, pixels - slab * SlabPixels);
    Eigen::ArrayXd &  sums = m_Slabs[slab];
    sums.resize(static_cast<Eigen::Index>((own + BlockPixels - 1) / BlockPixels * BlockPixels * series));
  }
  this->Clear(parallelFor); // the memory's first use is slow: all threads share it
}

void
ProjectionSums::Clear(const ParallelFor & parallelFor)
{
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    Eigen::ArrayXd & sums = m_Slabs[slab];
    ForBlocks(static_cast<std::size_t>(sums.size()), parallelFor, [&sums](std::size_t begin, std::size_t end) {
      std::fill(sums.data() + begin, sums.data() + end, 0.0);
    });
  }
}

template <typename TPixel>
void
ProjectionSums::AddFrames(const TemporalBasis & basis,
                          const TPixel *        frames,
                          std::size_t           firstFrame,
                          std::size_t           count,
                          std::size_t           begin,
                          std::size_t           end)
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    for (std::size_t t = 0; t < count; t += MostTogether)
    {
      this->AddTogether(basis, frames + t * m_Pixels, firstFrame + t, std::min(MostTogether, count - t), begin, end);
    }
  }
  else
  {
    this->AddOneByOne(basis, frames, firstFrame, count, begin, end);
  }
}

template <typename TPixel>
void
ProjectionSums::AddTogether(const TemporalBasis & basis,
                            const TPixel *        frames,
                            std::size_t           firstFrame,
                            std::size_t           count,
                            std::size_t           begin,
                            std::size_t           end)
{
  std::vector<SeriesWeights> weights;
  for (std::size_t j = 0; j < m_Series; ++j)
  {
    weights.push_back(WeightsOf<TPixel>(basis, j, firstFrame, count));
  }
  FramePairs values{};
  for (std::size_t p = begin; p < end;)
  {
    const std::size_t size = std::min(end, (p / BlockPixels + 1) * BlockPixels) - p;
    const std::size_t next = p + size;
    TakePairs(frames + p, m_Pixels, count, size, values);
    for (std::size_t j = 0; j < m_Series; ++j)
    {
      if (next < end) // the memory of the next block comes while this one is worked on
      {
        PrefetchValues(&this->At(next, j), BlockPixels);
        for (std::size_t t = j; t < count; t += m_Series)
        {
          PrefetchValues(frames + t * m_Pixels + next, BlockPixels);
        }
      }
      AddPairProducts(values, weights[j].pairs, weights[j].ofMiddle, size, &this->At(p, j));
    }
    p = next;
  }
}

template <typename TPixel>
void
ProjectionSums::AddOneByOne(const TemporalBasis & basis,
                            const TPixel *        frames,
                            std::size_t           firstFrame,
                            std::size_t           count,
                            std::size_t           begin,
                            std::size_t           end)
{
  for (std::size_t p = begin; p < end;)
  {
    const std::size_t size = std::min(end, (p / BlockPixels + 1) * BlockPixels) - p;
    for (std::size_t t = 0; t < count; ++t)
    {
      double values[BlockPixels];
      std::copy_n(frames + t * m_Pixels + p, size, values);
      for (std::size_t j = 0; j < m_Series; ++j)
      {
        const double weight = basis.Rounded(firstFrame + t, j);
        double *     sum = &this->At(p, j);
        for (std::size_t i = 0; i < size; ++i)
        {
          sum[i] += weight * values[i];
        }
      }
    }
    p += size;
  }
}

template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &,
                          const unsigned char *,
                          std::size_t,
                          std::size_t,
                          std::size_t,
                          std::size_t);
template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &,
                          const unsigned short *,
                          std::size_t,
                          std::size_t,
                          std::size_t,
                          std::size_t);
template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const short *, std::size_t, std::size_t, std::size_t, std::size_t);
template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const float *, std::size_t, std::size_t, std::size_t, std::size_t);
template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const double *, std::size_t, std::size_t, std::size_t, std::size_t);

void
ProjectionSums::Merge(const ProjectionSums & other)
{
  if (other.m_Pixels != m_Pixels || other.m_Series != m_Series || other.m_FirstSlab != m_FirstSlab ||
      other.m_LastSlab != m_LastSlab)
  {
    throw std::invalid_argument("projections of " + std::to_string(other.m_Pixels) + " pixels on " +
                                std::to_string(other.m_Series) + " series cannot be merged into those of " +
                                std::to_string(m_Pixels) + " pixels on " + std::to_string(m_Series));
  }
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    m_Slabs[slab] += other.m_Slabs[slab];
  }
}

void
ProjectionSums::Save(std::ostream & out) const
{
  WriteSumsHeader(out, Name, m_Pixels, 0);
  WriteCount(out, m_Series);
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    WriteNumbers(out, m_Slabs[slab].data(), static_cast<std::size_t>(m_Slabs[slab].size()));
  }
}

void
ProjectionSums::Restore(std::istream & in)
{
  ProjectionSums read(m_Pixels, m_Series, SerialFor, m_FirstSlab, m_LastSlab);
  ReadSumsHeader(in, Name, m_Pixels);
  RequireCount("series", ReadCount(in), m_Series);
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    ReadNumbers(in, read.m_Slabs[slab].data(), static_cast<std::size_t>(read.m_Slabs[slab].size()));
  }
  *this = std::move(read);
}

} // namespace sensornoise
