// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/PixelProjections.h"

#include "sensornoise/base/FreeMemory.h"
#include "sensornoise/refined/MemoryNeed.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

PixelProjections::PixelProjections(const FrameGeometry & geometry,
                                   FrameSample           sample,
                                   TemporalBasis         basis,
                                   const Options &       options,
                                   ParallelFor           parallelFor)
  : m_Geometry(geometry)
  , m_Basis(std::move(basis))
  , m_Options(options)
  , m_ParallelFor(std::move(parallelFor))
  , m_Sample(std::move(sample))
{
  if (!m_Options.sumsStay)
  {
    this->HoldSumsOfNextSlabs();
  }
}

std::size_t
PixelProjections::SlabsWithin(double bytes, std::size_t series)
{
  const double slab = MemoryNeed{ ProjectionSums::SlabPixels, 0 }.OfProjections(std::max<std::size_t>(1, series));
  return static_cast<std::size_t>(std::clamp(bytes / slab, 1.0, 1e9)); // of no limit, too
}

void
PixelProjections::HoldSumsOfNextSlabs()
{
  const std::size_t pixels = m_Geometry.Pixels();
  const std::size_t series = m_Basis.Size();
  const std::size_t first = m_NextSlab;
  m_NextSlab = std::min(ProjectionSums::NumberOfSlabs(pixels), first + m_Options.slabsAtOnce);
  if (first == 0)
  {
    GiveBackFreedMemory(); // the most is needed from here on
  }
  if (m_NextSlab - first == ProjectionSums::NumberOfSlabs(pixels))
  {
    RequireMemory(MemoryNeed{ pixels, 0 }.OfProjections(series),
                  "the projection of all pixels on " + std::to_string(series) +
                    " series of light and motion (a memory limit parts it)");
  }
  m_Sums = ProjectionSums(pixels, series, m_ParallelFor, first, m_NextSlab);
}

template <typename TPixel>
void
PixelProjections::AddFrames(const TPixel *         frames,
                            std::size_t            firstFrame,
                            std::size_t            count,
                            const ReferenceFrame & frame)
{
  const ProjectedFrames<TPixel> projected(m_Basis, frames, m_Geometry.Pixels(), firstFrame, count);
  if (m_NextSlab == 0 && count == frame.frames)
  {
    this->ProjectAll(projected, frame);
  }
  else
  {
    if (m_NextSlab == 0)
    {
      this->HoldSumsOfNextSlabs();
    }
    const std::size_t first = m_Sums.FirstPixel();
    ForBlocks(m_Sums.LastPixel() - first, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      m_Sums.AddFrames(projected, first + begin, first + end);
    });
  }
  if (!m_HasSample)
  {
    m_Sample.AddFrames(frames, firstFrame, count, frame.mean, m_ParallelFor);
  }
}

template <typename TPixel>
void
PixelProjections::ProjectAll(const ProjectedFrames<TPixel> & frames, const ReferenceFrame & frame)
{
  ProjectionSums light(m_Geometry.Pixels(), m_Options.keepLight ? m_Basis.NumberOfLightFactors() : 0, m_ParallelFor);
  m_Squares = MakeResidualSquares(frame, m_Basis, frames, light, m_ParallelFor);
  if (m_Options.keepLight)
  {
    m_Coordinates = PixelCoordinates(std::move(light));
  }
  m_IsProjected = true;
}

void
PixelProjections::Forget()
{
  m_Sums.Clear(m_ParallelFor);
  if (std::exchange(m_IsProjected, false))
  {
    m_Squares = {};
    m_Coordinates = {};
  }
  if (!m_HasSample)
  {
    m_Sample.Clear();
  }
}

void
PixelProjections::RequireShared() const
{
  if (m_Options.sumsStay)
  {
    throw std::logic_error("the sums of the third pass were to stay here; they are not saved or merged");
  }
}

void
PixelProjections::Save(std::ostream & out) const
{
  this->RequireShared();
  m_Sums.Save(out);
  if (!m_HasSample)
  {
    m_Sample.Save(out);
  }
}

void
PixelProjections::Merge(std::istream & in)
{
  this->RequireShared();
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
PixelProjections::EndPass(const ReferenceFrame & frame)
{
  m_HasSample = true;
  if (m_IsProjected)
  {
    return true;
  }
  const std::size_t pixels = m_Geometry.Pixels();
  const bool        keepAll = m_Options.keepLight && m_Sums.FirstPixel() == 0 && m_Sums.LastPixel() == pixels;
  AppendResidualSquares(frame, m_Basis, m_Sums, keepAll, m_ParallelFor, m_Squares);
  if (keepAll)
  {
    m_Coordinates = PixelCoordinates(std::move(m_Sums));
  }
  const bool isLast = m_Squares.rss.size() == pixels;
  if (!isLast)
  {
    this->HoldSumsOfNextSlabs();
  }
  return isLast;
}

void
PixelProjections::StartLight()
{
  m_Basis = m_Basis.OfLight();
  m_NextSlab = 0;
  m_Options.slabsAtOnce = ProjectionSums::NumberOfSlabs(m_Geometry.Pixels());
  this->HoldSumsOfNextSlabs();
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
