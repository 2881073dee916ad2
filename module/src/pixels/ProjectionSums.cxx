// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectionSums.h"

#include "base/BinaryStream.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"

#include <algorithm>
#include <cstddef>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr const char * Name = "ProjectionSums";
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
  this->Clear(parallelFor); // by all threads, because the first use of the memory is slow
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
ProjectionSums::AddFrames(const ProjectedFrames<TPixel> & frames, std::size_t begin, std::size_t end)
{
  for (std::size_t p = begin; p < end && m_Series > 0;)
  {
    const std::size_t next = std::min(end, (p / BlockPixels + 1) * BlockPixels);
    const bool        isLast = next == end;
    frames.AddTo(&this->At(p, 0), p, next, std::min(end, next + BlockPixels), isLast ? nullptr : &this->At(next, 0));
    p = next;
  }
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void ProjectionSums::AddFrames(const ProjectedFrames<TPixel> &, std::size_t, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

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
