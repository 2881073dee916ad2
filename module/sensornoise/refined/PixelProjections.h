// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelProjections_h
#define sensornoise_refined_PixelProjections_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/correlation/FrameSample.h"
#include "sensornoise/pixels/PixelCoordinates.h"
#include "sensornoise/pixels/ProjectionSums.h"
#include "sensornoise/pixels/ResidualSquares.h"
#include "sensornoise/series/TemporalBasis.h"

#include <cstddef>
#include <istream>
#include <ostream>
#include <utility>

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
    std::size_t slabsAtOnce{ 1 };   ///< slabs (ProjectionSums) that are projected in a pass
    bool        keepLight{ false }; ///< the coordinates on the series of light are needed
    bool        sumsStay{ false };  ///< no sums are saved or merged
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

  /** Adds frames firstFrame ... firstFrame + count - 1, stored one after the other; \a frame is what they are compared
   * with. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t firstFrame, std::size_t count, const ReferenceFrame & frame);

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
  void
  ProjectAll(const ProjectedFrames<TPixel> & frames, const ReferenceFrame & frame);

  FrameGeometry    m_Geometry;
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

extern template SensorNoise_EXPORT void
PixelProjections::AddFrames(const unsigned char *, std::size_t, std::size_t, const ReferenceFrame &);
extern template SensorNoise_EXPORT void
PixelProjections::AddFrames(const unsigned short *, std::size_t, std::size_t, const ReferenceFrame &);
extern template SensorNoise_EXPORT void
PixelProjections::AddFrames(const short *, std::size_t, std::size_t, const ReferenceFrame &);
extern template SensorNoise_EXPORT void
PixelProjections::AddFrames(const float *, std::size_t, std::size_t, const ReferenceFrame &);
extern template SensorNoise_EXPORT void
PixelProjections::AddFrames(const double *, std::size_t, std::size_t, const ReferenceFrame &);

} // namespace sensornoise

#endif
