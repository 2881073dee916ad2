// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/PixelProjections.h"

#include "sensornoise/refined/MemoryNeed.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <utility>

namespace sensornoise
{

PixelProjections::PixelProjections(const FrameGeometry & geometry,
                                   FrameSample           sample,
                                   TemporalBasis         basis,
                                   std::size_t           slabsAtOnce,
                                   ParallelFor           parallelFor)
  : m_Geometry(geometry)
  , m_Basis(std::move(basis))
  , m_SlabsAtOnce(slabsAtOnce)
  , m_ParallelFor(std::move(parallelFor))
  , m_Sums(this->SumsOfNextSlabs())
  , m_Sample(std::move(sample))
{}

std::size_t
PixelProjections::SlabsWithin(double bytes, std::size_t series)
{
  const double slab = MemoryNeed{ ProjectionSums::SlabPixels, 0 }.OfProjections(std::max<std::size_t>(1, series));
  return static_cast<std::size_t>(std::clamp(bytes / slab, 1.0, 1e9)); // of no limit, too
}

ProjectionSums
PixelProjections::SumsOfNextSlabs()
{
  const std::size_t first = m_NextSlab;
  m_NextSlab = std::min(ProjectionSums::NumberOfSlabs(m_Geometry.Pixels()), first + m_SlabsAtOnce);
  return ProjectionSums(m_Geometry.Pixels(), m_Basis.Size(), m_ParallelFor, first, m_NextSlab);
}

template <typename TPixel>
void
PixelProjections::AddFrames(const TPixel *         frames,
                            std::size_t            firstFrame,
                            std::size_t            count,
                            const ReferenceFrame & frame)
{
  const std::size_t first = m_Sums.FirstPixel();
  ForBlocks(m_Sums.LastPixel() - first, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    m_Sums.AddFrames(m_Basis, frames, firstFrame, count, first + begin, first + end);
  });
  if (!m_HasSample)
  {
    m_Sample.AddFrames(frames, firstFrame, count, frame.mean, m_ParallelFor);
  }
}

void
PixelProjections::Forget()
{
  m_Sums.Clear(m_ParallelFor);
  if (!m_HasSample)
  {
    m_Sample.Clear();
  }
}

void
PixelProjections::Save(std::ostream & out) const
{
  m_Sums.Save(out);
  if (!m_HasSample)
  {
    m_Sample.Save(out);
  }
}

void
PixelProjections::Merge(std::istream & in)
{
  ProjectionSums others = m_Sums;
  others.Restore(in);
  if (!m_HasSample)
  {
    FrameSample sample = m_Sample;
    sample.Restore(in);
    m_Sample.Merge(sample);
  }
  m_Sums.Merge(others);
}

bool
PixelProjections::EndPass(const ReferenceFrame & frame, bool keepForLight)
{
  m_HasSample = true;
  const std::size_t pixels = m_Geometry.Pixels();
  const bool        isWhole = m_Sums.FirstPixel() == 0 && m_Sums.LastPixel() == pixels;
  AppendResidualSquares(frame, m_Basis, m_Sums, keepForLight && isWhole, m_ParallelFor, m_Squares);
  if (keepForLight && isWhole)
  {
    m_Coordinates = PixelCoordinates(std::move(m_Sums));
  }
  const bool isLast = m_Squares.rss.size() == pixels;
  if (!isLast)
  {
    m_Sums = this->SumsOfNextSlabs();
  }
  return isLast;
}

void
PixelProjections::StartLight()
{
  m_Basis = m_Basis.OfLight();
  m_NextSlab = 0;
  m_SlabsAtOnce = ProjectionSums::NumberOfSlabs(m_Geometry.Pixels());
  m_Sums = this->SumsOfNextSlabs();
}

void
PixelProjections::EndLight(const ReferenceFrame & frame)
{
  m_Coordinates = PixelCoordinates(std::move(m_Sums), m_Basis, frame.mean, m_ParallelFor);
}

template SensorNoise_EXPORT void
PixelProjections::AddFrames(const unsigned char *, std::size_t, std::size_t, const ReferenceFrame &);
template SensorNoise_EXPORT void
PixelProjections::AddFrames(const unsigned short *, std::size_t, std::size_t, const ReferenceFrame &);
template SensorNoise_EXPORT void
PixelProjections::AddFrames(const short *, std::size_t, std::size_t, const ReferenceFrame &);
template SensorNoise_EXPORT void
PixelProjections::AddFrames(const float *, std::size_t, std::size_t, const ReferenceFrame &);
template SensorNoise_EXPORT void
PixelProjections::AddFrames(const double *, std::size_t, std::size_t, const ReferenceFrame &);

} // namespace sensornoise
