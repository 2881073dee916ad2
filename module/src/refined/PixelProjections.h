// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelProjections_h
#define sensornoise_refined_PixelProjections_h

#include "SensorNoiseExport.h"
#include "base/PixelLayout.h"
#include "correlation/FrameSample.h"
#include "moments/StackMaps.h"
#include "pixels/ProjectionSums.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class MemoryNeed
 * \brief Memory of RefinedMethod for frames of a size, without the frames that are handed to it [bytes].
 *
 * Computed from the data that are held at the same time, and measured to be enough: documentation/performance.md. */
struct MemoryNeed
{
  std::size_t pixels;
  std::size_t frames;

  /** Returns the memory that is needed for any number of temporal components: the maps, and the data between the
   * passes. It is the least memory limit. */
  double
  Least() const
  {
    return leastBytesPerPixel * static_cast<double>(pixels) + this->OfFrames();
  }
  /** Returns the memory of the third pass without its sums: mean and variance, residual squares and masks. */
  double
  BesideProjections() const
  {
    return mapBytesPerPixel * static_cast<double>(pixels) + this->OfFrames();
  }
  /** Returns the memory of the third pass's sums, for all pixels and \a series temporal components. */
  double
  OfProjections(std::size_t series, SumWidth width) const
  {
    return static_cast<double>(BytesOf(width) * pixels * series);
  }

private:
  static constexpr double leastBytesPerPixel = 64.0;
  static constexpr double mapBytesPerPixel = 34.0;
  static constexpr double bytesPerFrame = 20e3; // the products of pass 2, and a thumbnail

  double
  OfFrames() const
  {
    const std::size_t sample = std::min(SampleTiles::MostValuesOf(pixels), SampleTiles::MostPixels * frames);
    return bytesPerFrame * static_cast<double>(frames) + 4.0 * static_cast<double>(sample);
  }
};

/** Throws std::invalid_argument if \a limitBytes is less than the memory that \a planes frames of the size \a geometry
 * need at once. */
SensorNoise_EXPORT void
RequireMemoryLimit(double limitBytes, const FrameGeometry & geometry, std::size_t frames, std::size_t planes);

struct ReferenceFrame;

/** \class PixelProjections
 * \brief Sums of the third pass: the projections of every pixel on every temporal component, and a sample of complete
 * time series.
 *
 * Where the sums of all pixels exceed the memory limit, the pass is repeated for as many slabs of pixels as fit each
 * time. If the illumination is local, a last pass has the illumination components alone, for all pixels. If no other
 * process adds to the sums, and all frames are added together, no sums are held: a block of pixels is projected at
 * once. The results of each pixel are identical in all cases. */
class SensorNoise_EXPORT PixelProjections
{
public:
  struct Options
  {
    std::size_t slabsAtOnce{ 1 };               ///< slabs (ProjectionSums) that are projected in a pass
    bool        keepIllumination{ false };      ///< whether the coordinates on the illumination components are needed
    bool        withoutMerging{ false };        ///< whether no sums are saved or merged
    SumWidth    width{ SumWidth::Wide };        ///< how the sums are held
    Precision   precision{ Precision::Double }; ///< how the residual squares are held
  };

  /** Prepares the first pass over frames of \a geometry. \a sample must be empty, and is filled in the first pass. */
  PixelProjections(const FrameGeometry & geometry,
                   FrameSample           sample,
                   TemporalBasis         basis,
                   const Options &       options,
                   ParallelFor           parallelFor);

  /** Returns the number of slabs that can be projected at once in \a bytes bytes with \a series temporal components: at
   * least 1. */
  static std::size_t
  SlabsWithin(double bytes, std::size_t series, SumWidth width);

  /** Returns the size of the sums of a pixel, one for each temporal component [bytes]. */
  std::size_t
  BytesPerPixel() const
  {
    return BytesOf(m_Options.width) * m_Basis.Size();
  }
  const TemporalBasis &
  GetBasis() const
  {
    return m_Basis;
  }
  /** Returns whether sums of the pixels are held if the next frames are \a count of \a frames. */
  bool
  HoldsSums(std::size_t count, std::size_t frames) const
  {
    return m_NextSlab > 0 || count < frames;
  }

  /** Sets the memory layout of the pixels of the frames that are added. Default: one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
    m_Sample.SetLayout(layout);
  }

  /** A plane of a mosaic, or a whole frame: its projections, the index of the first frame among the distinct frames,
   * and the reference frame. */
  struct Plane
  {
    PixelProjections *     projections;
    std::size_t            first;
    const ReferenceFrame * frame;
  };
  /** Adds \a count frames to all \a planes, which must have one size. A row that one plane has read is still in the
   * cache when the next plane reads it. */
  template <typename TPixel>
  static void
  AddFrames(const std::vector<Plane> & planes,
            const TPixel *             frames,
            std::size_t                count,
            const ParallelFor &        parallelFor);

  /** Removes all frames that were added in the current pass. */
  void
  Forget();

  /** Writes the sums of the current pass, see BinaryStream. Throws std::logic_error if Options::withoutMerging is set.
   */
  void
  Save(std::ostream & out) const;
  /** Adds the sums of other frames that another object saved in the same pass. Throws std::logic_error if
   * Options::withoutMerging is set. */
  void
  Merge(std::istream & in);

  /** Ends a pass. Returns whether all pixels have been projected; else the next pass is for the following slabs. The
   * coordinates are discarded, unless one pass made them for all pixels and Options::keepIllumination is set. */
  bool
  EndPass(const ReferenceFrame & frame);

  /** Returns whether the coordinates of all pixels on the illumination components are available. */
  bool
  HasCoordinates() const
  {
    return m_Coordinates.GetNumberOfSeries() > 0;
  }
  /** Start and end a further pass for the illumination components alone. */
  void
  StartIlluminationPass();
  void
  EndIlluminationPass(const ReferenceFrame & frame);

  /** Return the results of the passes, which are moved out of the object. */
  ResidualSquares
  TakeSquares()
  {
    return std::move(m_Squares);
  }
  FrameSample
  TakeSample()
  {
    return std::move(m_Sample);
  }
  PixelCoordinates
  TakeCoordinates()
  {
    return std::move(m_Coordinates);
  }

private:
  void
  AllocateNextSlabs();
  /** Returns the coordinates of all pixels on the illumination components, if they are needed, to be filled. */
  PixelCoordinates
  MakeCoordinates() const;
  void
  RequireMerging() const;
  template <typename TPixel>
  struct Batch;

  FrameGeometry    m_Geometry;
  PixelLayout      m_Layout;
  TemporalBasis    m_Basis; // basis of the current pass
  Options          m_Options;
  ParallelFor      m_ParallelFor;
  std::size_t      m_NextSlab{ 0 };
  bool             m_IsProjected{ false }; // all pixels, without sums
  ProjectionSums   m_Sums;
  FrameSample      m_Sample;
  bool             m_HasSample{ false };
  ResidualSquares  m_Squares;
  PixelCoordinates m_Coordinates;
};

/** Returns whether pixels can be projected on the levels of the distinct frames, \a frameMeans [DN]: the levels are
 * finite and differ, and degrees of freedom remain. */
SensorNoise_EXPORT bool
AreLevelsSeries(const std::vector<double> & frameMeans);

/** \class LevelProjection
 * \brief One more reading of a stack under strong changes of the illumination: computes the variance of every pixel
 * without the component that is proportional to the levels of the frames.
 *
 * The raw variance of a pixel of signal s is V + sigma_gamma^2 s^2. Where the second term is 100 times the first, no
 * model of the raw variance determines V. The residual variance after the projection on the series of the frames' mean
 * levels is V, if the illumination is the same everywhere and nothing moves. It needs no offset. Estimator.md, 3.2.
 *
 * The sums are the same as in PixelProjections, 8 bytes for each pixel: identical for any chunks and any distribution
 * over processes. */
class SensorNoise_EXPORT LevelProjection
{
public:
  /** \a frameMeans are the mean levels of the distinct frames [DN], see AreLevelsSeries(). \a withoutMerging: no sums
   * are saved or merged. */
  LevelProjection(StackMaps                   maps,
                  const FrameGeometry &       geometry,
                  const PixelLayout &         layout,
                  const std::vector<double> & frameMeans,
                  bool                        withoutMerging,
                  const ParallelFor &         parallelFor);

  /** Returns the target to which frames are added; \a place is the index of the first frame among the distinct frames.
   */
  PixelProjections::Plane
  PlaneAt(std::size_t place)
  {
    return { &m_Projections, place, &m_Frame };
  }
  PixelProjections &
  GetProjections()
  {
    return m_Projections;
  }
  const PixelProjections &
  GetProjections() const
  {
    return m_Projections;
  }
  /** Returns the reference frame, with the raw variance [DN^2]. */
  const ReferenceFrame &
  GetFrame() const
  {
    return m_Frame;
  }

  /** Maps of the stack, with the residual variance instead of the raw variance. */
  struct Maps
  {
    StackMaps           ofScene;
    std::vector<double> rawVariance; ///< raw variance [DN^2]
  };
  /** Ends the reading and returns the maps. */
  Maps
  TakeMaps(const ParallelFor & parallelFor);

private:
  StackSummary              m_Summary;
  std::vector<std::uint8_t> m_Valid;
  ReferenceFrame            m_Frame;
  PixelProjections          m_Projections;
};

} // namespace sensornoise

#endif
