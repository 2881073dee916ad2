// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelProjections_h
#define sensornoise_refined_PixelProjections_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "correlation/FrameSample.h"
#include "pixels/PixelCoordinates.h"
#include "pixels/ProjectionSums.h"
#include "pixels/ResidualSquares.h"
#include "series/TemporalBasis.h"

#include <cstddef>
#include <istream>
#include <ostream>
#include <utility>
#include <vector>

namespace sensornoise
{

struct ReferenceFrame;

/** \class PixelProjections
 * \brief What the third pass gathers: the sums of every pixel with every series, and a sample of whole time series.
 *
 * Where the sums of all pixels at once are too large for the memory, the pass is repeated, each time for as many slabs
 * of pixels as fit; a last one, if the light is local, is for the series of light alone, of all pixels. Where no other
 * process adds to the sums, and all frames are added together, none are held: a block of pixels is projected at once.
 * Each pixel's numbers have the same bits in every way. */
class SensorNoise_EXPORT PixelProjections
{
public:
  struct Options
  {
    std::size_t slabsAtOnce{ 1 };        ///< slabs (ProjectionSums) that are projected in a pass
    bool        keepLight{ false };      ///< the coordinates on the series of light are needed
    bool        withoutMerging{ false }; ///< no sums are saved or merged
  };

  /** For frames of \a geometry; \a sample is to be filled in the first pass. */
  PixelProjections(const FrameGeometry & geometry,
                   FrameSample           sample,
                   TemporalBasis         basis,
                   const Options &       options,
                   ParallelFor           parallelFor);

  /** The slabs of frames of \a pixels pixels that can be projected at once in \a bytes bytes: at least 1. */
  static std::size_t
  SlabsWithin(double bytes, std::size_t series);

  std::size_t
  SumsPerPixel() const
  {
    return m_Basis.Size();
  }
  const TemporalBasis &
  GetBasis() const
  {
    return m_Basis;
  }

  /** The pixels of the frames to come stand as \a layout says; without it, one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
    m_Sample.SetLayout(layout);
  }

  /** One of the planes of a mosaic, or a frame: the number of the first frame among its own, and what its frames are
   * compared with. */
  struct Plane
  {
    PixelProjections *     projections;
    std::size_t            first;
    const ReferenceFrame * frame;
  };
  /** Adds \a count frames to all \a planes, of one size: what one has read of a row is near when the next comes to it.
   */
  template <typename TPixel>
  static void
  AddFrames(const std::vector<Plane> & planes,
            const TPixel *             frames,
            std::size_t                count,
            const ParallelFor &        parallelFor);

  /** Takes back all that was added in the current pass. */
  void
  Forget();

  /** Writes the sums of the current pass, see BinaryStream. Throws std::logic_error if sums stay. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums of other frames that another object saved in the same pass. Throws std::logic_error if sums stay. */
  void
  Merge(std::istream & in);

  /** Ends a pass. Returns whether all pixels have been projected, else the next pass is for the slabs that follow. The
   * coordinates are given back, unless all pixels' were made in one pass and are to be kept for the light. */
  bool
  EndPass(const ReferenceFrame & frame);

  /** Whether the coordinates of all pixels on the series of light are there. */
  bool
  HasCoordinates() const
  {
    return m_Coordinates.LastPixel() > m_Coordinates.FirstPixel();
  }
  /** The next pass is for the series of light alone. */
  void
  StartLight();
  void
  EndLight(const ReferenceFrame & frame);

  /** Give away what the passes have found. */
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
  HoldSumsOfNextSlabs();
  void
  RequireShared() const;
  template <typename TPixel>
  struct Batch;

  FrameGeometry    m_Geometry;
  PixelLayout      m_Layout;
  TemporalBasis    m_Basis; // of the current pass
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

} // namespace sensornoise

#endif
