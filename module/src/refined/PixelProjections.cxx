// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/PixelProjections.h"

#include "base/Eigen.h"
#include "base/FreeMemory.h"
#include "base/NothingToMeasure.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "correlation/FrameSample.h"
#include "moments/StackFrames.h"
#include "pixels/ProjectedFrames.h"
#include "refined/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/FrameGeometry.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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
  , m_Layout(PixelLayout::OfFrames(geometry))
  , m_Basis(std::move(basis))
  , m_Options(options)
  , m_ParallelFor(std::move(parallelFor))
  , m_Sample(std::move(sample))
  , m_Squares{ PixelMap(options.precision), {} }
{
  if (!m_Options.withoutMerging)
  {
    this->AllocateNextSlabs();
  }
}

std::size_t
PixelProjections::SlabsWithin(double bytes, std::size_t series, SumWidth width)
{
  const double slab =
    MemoryNeed{ ProjectionSums::SlabPixels, 0 }.OfProjections(std::max<std::size_t>(1, series), width);
  return static_cast<std::size_t>(std::clamp(bytes / slab, 1.0, 1e9)); // also for an infinite limit
}

void
PixelProjections::AllocateNextSlabs()
{
  const std::size_t pixels = m_Geometry.Pixels();
  const std::size_t series = m_Basis.Size();
  const std::size_t first = m_NextSlab;
  m_NextSlab = std::min(ProjectionSums::NumberOfSlabs(pixels), first + m_Options.slabsAtOnce);
  if (first == 0)
  {
    ReleaseFreedMemory(); // most memory is needed from here on
  }
  if (m_NextSlab - first == ProjectionSums::NumberOfSlabs(pixels))
  {
    RequireMemory(MemoryNeed{ pixels, 0 }.OfProjections(series, m_Options.width),
                  "the projection of all pixels on " + std::to_string(series) +
                    " components of illumination and motion (a memory limit divides the projection)");
  }
  m_Sums = ProjectionSums(pixels, series, m_ParallelFor, first, m_NextSlab, m_Options.width);
}

/** Frames that are added to the sums of a plane, or to its residual squares if they are all frames. */
template <typename TPixel>
struct PixelProjections::Batch
{
  PixelProjections *      to;
  const ReferenceFrame *  frame;
  ProjectedFrames<TPixel> projected;
  PixelCoordinates ofIllumination; // coordinates for the illumination components, if all frames are added at once

  Batch(const Plane & plane, const TPixel * frames, std::size_t count)
    : to(plane.projections)
    , frame(plane.frame)
    , projected(to->m_Basis, frames, to->m_Layout, plane.first, count)
  {
    if (to->m_NextSlab > 0) // sums are held
    {
      return;
    }
    if (count < frame->frames)
    {
      to->AllocateNextSlabs();
      return;
    }
    const std::size_t pixels = to->m_Geometry.Pixels();
    ofIllumination = to->MakeCoordinates();
    for (std::size_t p = 0; p < pixels; p += ProjectionSums::SlabPixels)
    {
      ofIllumination.AllocateSlabOf(p);
    }
    to->m_Squares.rss.Reserve(pixels);
    to->m_Squares.rss.Grow(pixels, to->m_ParallelFor);
    to->m_Squares.skew = MakeMap<float>(pixels, to->m_ParallelFor);
    to->m_IsProjected = true;
  }

  /** Adds the pixels [begin, end), as far as they belong to the current slabs. */
  void
  AddBlock(std::size_t begin, std::size_t end)
  {
    if (to->m_IsProjected)
    {
      FillResidualSquares(*frame, to->m_Basis, projected, begin, end, to->m_Squares, ofIllumination);
      return;
    }
    begin = std::max(begin, to->m_Sums.FirstPixel());
    to->m_Sums.AddFrames(projected, begin, std::max(begin, std::min(end, to->m_Sums.LastPixel())));
  }

  void
  End()
  {
    if (to->m_IsProjected && to->m_Options.keepIllumination)
    {
      to->m_Coordinates = std::move(ofIllumination);
    }
  }
};

template <typename TPixel>
void
PixelProjections::AddFrames(const std::vector<Plane> & planes,
                            const TPixel *             frames,
                            std::size_t                count,
                            const ParallelFor &        parallelFor)
{
  std::vector<Batch<TPixel>> batches;
  batches.reserve(planes.size());
  for (const Plane & plane : planes)
  {
    batches.emplace_back(plane, frames, count);
  }
  ForBlocks(planes.front().projections->m_Geometry.Pixels(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (Batch<TPixel> & batch : batches)
    {
      batch.AddBlock(begin, end);
    }
  });
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    batches[i].End();
    PixelProjections & own = *planes[i].projections;
    if (!own.m_HasSample)
    {
      own.m_Sample.AddFrames(frames, planes[i].first, count, planes[i].frame->mean, parallelFor);
    }
  }
}

void
PixelProjections::Forget()
{
  m_Sums.Clear(m_ParallelFor);
  if (std::exchange(m_IsProjected, false))
  {
    m_Squares = { PixelMap(m_Options.precision), {} };
    m_Coordinates = PixelCoordinates();
  }
  if (!m_HasSample)
  {
    m_Sample.Clear();
  }
}

PixelCoordinates
PixelProjections::MakeCoordinates() const
{
  return PixelCoordinates(m_Geometry.Pixels(), m_Options.keepIllumination ? m_Basis.NumberOfIlluminationFactors() : 0);
}

void
PixelProjections::RequireMerging() const
{
  if (m_Options.withoutMerging)
  {
    throw std::logic_error("the sums of the third pass were to stay here; they are not saved or merged");
  }
}

void
PixelProjections::Save(std::ostream & out) const
{
  this->RequireMerging();
  m_Sums.Save(out);
  if (!m_HasSample)
  {
    m_Sample.Save(out);
  }
}

void
PixelProjections::Merge(std::istream & in)
{
  this->RequireMerging();
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
  const bool        keepAll = m_Options.keepIllumination && m_Sums.FirstPixel() == 0 && m_Sums.LastPixel() == pixels;
  if (keepAll)
  {
    m_Coordinates = this->MakeCoordinates();
  }
  AppendResidualSquares(frame, m_Basis, m_Sums, m_ParallelFor, m_Squares, m_Coordinates);
  const bool isLast = m_Squares.rss.size() == pixels;
  if (!isLast)
  {
    this->AllocateNextSlabs();
  }
  return isLast;
}

void
PixelProjections::StartIlluminationPass()
{
  m_Basis = m_Basis.OfIllumination();
  m_NextSlab = 0;
  m_Options.slabsAtOnce = ProjectionSums::NumberOfSlabs(m_Geometry.Pixels());
  this->AllocateNextSlabs();
}

void
PixelProjections::EndIlluminationPass(const ReferenceFrame & frame)
{
  m_Coordinates = this->MakeCoordinates();
  FillCoordinates(frame, m_Basis, m_Sums, m_ParallelFor, m_Coordinates);
}

#define SensorNoise_INSTANTIATE(TPixel)                         \
  template SensorNoise_EXPORT void PixelProjections::AddFrames( \
    const std::vector<Plane> &, const TPixel *, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

namespace
{
/** Returns the basis of the frames' levels, centred and divided by their range. */
TemporalBasis
BasisOfLevels(const std::vector<double> & frameMeans)
{
  const auto   count = static_cast<double>(frameMeans.size());
  const double mean = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / count;
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  std::vector<double> levels;
  levels.reserve(frameMeans.size());
  for (const double level : frameMeans)
  {
    levels.push_back((level - mean) / (*highest - *lowest));
  }
  const Eigen::MatrixXd none(static_cast<Eigen::Index>(frameMeans.size()), 0);
  return { levels, none, none };
}

/** Returns the least-squares slope of \a skew over the mean [1]. */
double
SlopeOfSkew(const ReferenceFrame & frame, const std::vector<float> & skew)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  double                         level = 0.0;
  double                         centre = 0.0;
  for (const std::size_t p : pixels)
  {
    level += frame.mean[p] / static_cast<double>(pixels.size());
    centre += static_cast<double>(skew[p]) / static_cast<double>(pixels.size());
  }
  double products = 0.0;
  double squares = 0.0;
  for (const std::size_t p : pixels)
  {
    products += (frame.mean[p] - level) * (static_cast<double>(skew[p]) - centre);
    squares += (frame.mean[p] - level) * (frame.mean[p] - level);
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/** Returns an approximate gain. The projection reduces shot noise by g times \a skew over \a freedom, so that the slope
 * of the residual variance over the level is too small by a known factor. */
double
RoughGain(const ReferenceFrame & frame, const std::vector<float> & skew, double dof)
{
  try
  {
    const double slope = FitInitialNoiseModel(frame).slopeDn;
    const double taken = SlopeOfSkew(frame, skew) / dof;
    return slope / std::max(InRefined.leastShotLeft, 1.0 - taken);
  }
  catch (const NothingToMeasure &)
  {
    return 0.0; // the same failure follows when the scene is made
  }
}
} // namespace

bool
AreLevelsSeries(const std::vector<double> & frameMeans)
{
  const bool areFinite =
    std::all_of(frameMeans.begin(), frameMeans.end(), [](double level) { return std::isfinite(level); });
  return areFinite && frameMeans.size() >= MinimumFrames &&
         *std::min_element(frameMeans.begin(), frameMeans.end()) <
           *std::max_element(frameMeans.begin(), frameMeans.end());
}

LevelProjection::LevelProjection(StackMaps                   maps,
                                 const FrameGeometry &       geometry,
                                 const PixelLayout &         layout,
                                 const std::vector<double> & frameMeans,
                                 bool                        withoutMerging,
                                 const ParallelFor &         parallelFor)
  : m_Summary(maps.summary)
  , m_Valid(std::move(maps.valid))
  , m_Frame(MakeReferenceFrame(std::move(maps.mean),
                               std::move(maps.variance),
                               m_Valid,
                               geometry,
                               frameMeans.size(),
                               parallelFor))
  , m_Projections(geometry,
                  FrameSample(),
                  BasisOfLevels(frameMeans),
                  { ProjectionSums::NumberOfSlabs(geometry.Pixels()), false, withoutMerging, SumWidth::Wide },
                  parallelFor)
{
  m_Projections.SetLayout(layout);
}

LevelProjection::Maps
LevelProjection::TakeMaps(const ParallelFor & parallelFor)
{
  m_Projections.EndPass(m_Frame);
  ResidualSquares     squares = m_Projections.TakeSquares();
  const double        dof = static_cast<double>(m_Frame.frames) - 2.0;
  std::vector<double> raw = m_Frame.variance.TakeDoubles();
  m_Frame.variance = std::move(squares.rss);
  ForPixels(raw.size(), parallelFor, [&](std::size_t p) { m_Frame.variance.Set(p, m_Frame.variance[p] / dof); });
  const double gain = RoughGain(m_Frame, squares.skew, dof);
  ForPixels(raw.size(), parallelFor, [&](std::size_t p) {
    const double added = gain * static_cast<double>(squares.skew[p]) / dof;
    m_Frame.variance.Set(p, m_Frame.variance[p] + (raw[p] > 0.0 ? added : 0.0)); // a constant pixel keeps 0
  });
  return { { m_Summary, std::move(m_Frame.mean), m_Frame.variance.TakeDoubles(), std::move(m_Valid) }, std::move(raw) };
}

} // namespace sensornoise
