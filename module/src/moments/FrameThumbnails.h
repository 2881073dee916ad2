// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FrameThumbnails_h
#define sensornoise_moments_FrameThumbnails_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** How much of what frames show differs from frame to frame, without flicker and noise: by the median cell, as if the
 * differences were normal, so that things which cross a smaller part count little; medians over the frames. */
struct SceneChange
{
  double share{ 0.0 };      ///< of the variance over the cells of a frame, at most 1 [1]
  double ofTheLevel{ 0.0 }; ///< root of that variance over the mean level of the frames [1]

  /** Whether the frames show one scene no more, or never did. */
  bool
  IsLarge() const;
};

/** \class FrameThumbnails
 * \brief The means of each frame over up to 16 x 16 cells: whether all frames show one scene.
 *
 * Of a static scene the cells of a frame follow those of the mean frame, up to flicker, a level, noise, and light that
 * is not the same everywhere. Where another axis was taken for time, or the scene changes, or the camera moves by many
 * pixels, they do not. Two rows of each cell are looked at. */
class SensorNoise_EXPORT FrameThumbnails
{
public:
  /** \a mask, if not empty, has a nonzero value at the pixels to be used. */
  FrameThumbnails(const FrameGeometry & geometry, std::size_t frames, const std::vector<std::uint8_t> & mask);

  /** Adds frames first ... first + count - 1, stored one after the other. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    this->AddFrames(frames, PixelLayout::OfPixels(m_Pixels, m_Pixels), first, count, parallelFor);
  }
  /** The same for frames whose pixels stand as \a layout says. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *      frames,
            const PixelLayout & layout,
            std::size_t         first,
            std::size_t         count,
            const ParallelFor & parallelFor);

  void
  Save(std::ostream & out) const;
  /** What Save() wrote of other frames. Throws std::runtime_error if the stream ends early. */
  FrameThumbnails
  ReadOther(std::istream & in) const;
  /** Adds frames that were not added here. */
  void
  Merge(const FrameThumbnails & other);

  /** Over the \a frames, when all have been added. Nothing changes where fewer than 5 frames or 9 cells tell. */
  SceneChange
  FindChange(const std::vector<std::size_t> & frames) const;

  /** The relative standard deviation of the illumination factor over the \a frames [1], see
   * ComputeIlluminationChange(); 0 where fewer than 5 frames or 9 cells tell. When all frames have been added. */
  double
  FindIlluminationChange(const std::vector<std::size_t> & frames) const;

  std::size_t
  NumberOfFrames() const
  {
    return m_Frames;
  }
  std::size_t
  NumberOfCells() const
  {
    return m_Cells;
  }
  /** Pixels of a cell that are looked at, of the average cell. */
  double
  PixelsOfCell() const;
  /** Mean of a cell in frame \a t [DN]; NaN: nothing finite is there. */
  double
  MeanOf(std::size_t t, std::size_t cell) const
  {
    return m_Means[t * m_Cells + cell];
  }
  /** The means of \a cells in frame \a t [DN]. */
  std::vector<double>
  MeansOf(std::size_t t, const std::vector<std::size_t> & cells) const;
  /** Returns, for each cell, whether all of its pixels that are looked at are nonzero in \a mask, of a frame's size. */
  std::vector<bool>
  FindCellsWithin(const std::vector<std::uint8_t> & mask) const;
  /** Variance of the cells' means in frame \a t by what neighbouring pixels differ by: noise and texture [DN^2]. */
  double
  NoiseOf(std::size_t t) const
  {
    return m_Noise[t];
  }
  /** Share of the cells of frame \a t in which no two neighbours differ [1]. */
  double
  EvenShareOf(std::size_t t) const
  {
    return m_EvenShares[t];
  }

private:
  /** The cells that tell, and their means over the frames [DN]; none where frames or cells are too few. */
  struct MeanFrame
  {
    std::vector<std::size_t> cells;
    std::vector<double>      means;
  };

  MeanFrame
  FindMeanFrame(const std::vector<std::size_t> & frames) const;

  /** A part of a row of a cell. */
  struct Run
  {
    std::size_t cell;
    std::size_t begin; ///< pixels of a frame
    std::size_t end;
  };

  std::size_t               m_Pixels;
  std::size_t               m_Frames;
  std::size_t               m_Cells;
  std::vector<Run>          m_Runs;
  std::vector<std::uint8_t> m_Mask;
  std::vector<double>       m_Means; // of the cells, frame by frame [DN]; NaN: nothing finite
  std::vector<double>       m_Noise; // of these means, the mean over the cells [DN^2]
  std::vector<double>       m_EvenShares;
};

} // namespace sensornoise

#endif
