// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ProjectionSums.h"

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

namespace
{
constexpr const char * Name = "ProjectionSums";
} // namespace

ProjectionSums::ProjectionSums(std::size_t pixels, std::size_t series, const ParallelFor & parallelFor)
  : m_Pixels(pixels)
  , m_Series(series)
  , m_Sums(static_cast<Eigen::Index>((pixels + BlockPixels - 1) / BlockPixels * BlockPixels * series))
{
  // The memory's first use is slow: all threads share it.
  ForBlocks(static_cast<std::size_t>(m_Sums.size()), parallelFor, [this](std::size_t begin, std::size_t end) {
    std::fill(m_Sums.data() + begin, m_Sums.data() + end, 0.0);
  });
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
  if (other.m_Pixels != m_Pixels || other.m_Series != m_Series)
  {
    throw std::invalid_argument("projections of " + std::to_string(other.m_Pixels) + " pixels on " +
                                std::to_string(other.m_Series) + " series cannot be merged into those of " +
                                std::to_string(m_Pixels) + " pixels on " + std::to_string(m_Series));
  }
  m_Sums += other.m_Sums;
}

void
ProjectionSums::Save(std::ostream & out) const
{
  WriteSumsHeader(out, Name, m_Pixels, 0);
  WriteCount(out, m_Series);
  WriteNumbers(out, m_Sums.data(), static_cast<std::size_t>(m_Sums.size()));
}

void
ProjectionSums::Restore(std::istream & in)
{
  ProjectionSums read(m_Pixels, m_Series);
  ReadSumsHeader(in, Name, m_Pixels);
  RequireCount("series", ReadCount(in), m_Series);
  ReadNumbers(in, read.m_Sums.data(), static_cast<std::size_t>(read.m_Sums.size()));
  *this = std::move(read);
}

} // namespace sensornoise
