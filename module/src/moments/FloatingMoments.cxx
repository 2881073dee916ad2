// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FloatingMoments.h"

#include "base/BinaryStream.h"
#include "base/FirstTouch.h"

#include <algorithm>
#include <cstddef>
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
  TPixel                room[blockSize];
  for (std::size_t block = begin; block < end; block += blockSize)
  {
    const std::size_t blockEnd = std::min(block + blockSize, end);
    for (std::size_t t = 0; t < frames; ++t)
    {
      const TPixel * const values = layout.SideBySide(firstFrame + t * layout.frame, block, blockEnd, room);
      const double         share = 1.0 / static_cast<double>(m_Frames + t + 1);
      for (std::size_t p = block; p < blockEnd; ++p)
      {
        const double value = values[p - block];
        const double deviation = value - m_Mean[p];
        m_Mean[p] += deviation * share;
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
                                " pixels cannot be merged into those of frames of " +
                                std::to_string(this->GetNumberOfPixels()) + " pixels");
  }
  const std::size_t frames = m_Frames + later.m_Frames;
  if (later.m_Frames == 0)
  {
    return;
  }
  const double share = static_cast<double>(later.m_Frames) / static_cast<double>(frames);
  const double weight = static_cast<double>(m_Frames) * share;
  for (std::size_t p = 0; p < m_Mean.size(); ++p)
  {
    const double deviation = later.m_Mean[p] - m_Mean[p];
    m_Mean[p] += deviation * share;
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
