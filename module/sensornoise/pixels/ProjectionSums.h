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
#ifndef sensornoise_pixels_ProjectionSums_h
#define sensornoise_pixels_ProjectionSums_h

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace sensornoise
{

/** \class ProjectionSums
 * \brief The third pass: the sums over time of every pixel with each series of a TemporalBasis.
 *
 * With moments and these sums, the residual sum of squares of any pixel about any of the series follows without reading
 * the stack again (estimator.md, 6). For integer pixels they are exact integers, held in doubles: up to 2^16 frames,
 * frames may be added and parts merged in any order, with the same bits. Floating-point frames are added one by one in
 * time order.
 *
 * Memory: 8 bytes a pixel and series. */
class ProjectionSums
{
public:
  /** Pixels whose sums with one series lie side by side; those of a block stay in the first-level cache. */
  static constexpr std::size_t BlockPixels = 256;

  explicit ProjectionSums(std::size_t pixels = 0, std::size_t series = 0, const ParallelFor & parallelFor = SerialFor)
    : m_Pixels(pixels)
    , m_Series(series)
    , m_Sums(static_cast<Eigen::Index>((pixels + BlockPixels - 1) / BlockPixels * BlockPixels * series))
  {
    // The memory's first use is slow: all threads share it.
    ForBlocks(static_cast<std::size_t>(m_Sums.size()), parallelFor, [this](std::size_t begin, std::size_t end) {
      std::fill(m_Sums.data() + begin, m_Sums.data() + end, 0.0);
    });
  }

  /** Adds frames firstFrame ... firstFrame + count - 1, stored one after the other, for the pixels [begin, end).
   * Different ranges may be added at the same time. */
  template <typename TPixel>
  void
  AddFrames(const TemporalBasis & basis,
            const TPixel *        frames,
            std::size_t           firstFrame,
            std::size_t           count,
            std::size_t           begin,
            std::size_t           end)
  {
    constexpr std::size_t together = std::is_integral_v<TPixel> ? 4 : 1;
    for (std::size_t p = begin; p < end;)
    {
      const std::size_t size = std::min(end, (p / BlockPixels + 1) * BlockPixels) - p;
      for (std::size_t t = 0; t < count; t += together)
      {
        double values[together][BlockPixels];
        for (std::size_t k = 0; k < together; ++k)
        {
          std::copy_n(frames + std::min(t + k, count - 1) * m_Pixels + p, size, values[k]);
        }
        for (std::size_t j = 0; j < m_Series; ++j)
        {
          double weights[together];
          for (std::size_t k = 0; k < together; ++k)
          {
            weights[k] = t + k < count ? basis.Rounded(firstFrame + t + k, j) : 0.0;
          }
          double * sum = &this->At(p, j);
          for (std::size_t i = 0; i < size; ++i)
          {
            double added = 0.0;
            for (std::size_t k = 0; k < together; ++k)
            {
              added += weights[k] * values[k][i];
            }
            sum[i] += added;
          }
        }
      }
      p += size;
    }
  }

  /** Adds the sums of other frames of the same pixels. */
  void
  Merge(const ProjectionSums & other)
  {
    if (other.m_Pixels != m_Pixels || other.m_Series != m_Series)
    {
      throw std::invalid_argument("projections of " + std::to_string(other.m_Pixels) + " pixels on " +
                                  std::to_string(other.m_Series) + " series cannot be merged into those of " +
                                  std::to_string(m_Pixels) + " pixels on " + std::to_string(m_Series));
    }
    m_Sums += other.m_Sums;
  }

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const
  {
    WriteSumsHeader(out, Name, m_Pixels, 0);
    WriteCount(out, m_Series);
    WriteNumbers(out, m_Sums.data(), static_cast<std::size_t>(m_Sums.size()));
  }

  /** Replaces the sums by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums, or
   * those of other numbers of pixels or series, or ends early. */
  void
  Restore(std::istream & in)
  {
    ProjectionSums read(m_Pixels, m_Series);
    ReadSumsHeader(in, Name, m_Pixels);
    RequireCount("series", ReadCount(in), m_Series);
    ReadNumbers(in, read.m_Sums.data(), static_cast<std::size_t>(read.m_Sums.size()));
    *this = std::move(read);
  }

  std::size_t
  GetNumberOfSeries() const
  {
    return m_Series;
  }
  /** The sum of pixel \a p with series \a j. Those of the next pixels of its block follow. */
  double &
  At(std::size_t p, std::size_t j)
  {
    return m_Sums.data()[this->IndexOf(p, j)];
  }
  double
  At(std::size_t p, std::size_t j) const
  {
    return m_Sums.data()[this->IndexOf(p, j)];
  }

private:
  std::size_t
  IndexOf(std::size_t p, std::size_t j) const
  {
    return (p / BlockPixels * m_Series + j) * BlockPixels + p % BlockPixels;
  }

  static constexpr const char * Name = "ProjectionSums";

  std::size_t    m_Pixels;
  std::size_t    m_Series;
  Eigen::ArrayXd m_Sums; // unlike std::vector, not filled by one thread
};

} // namespace sensornoise

#endif
