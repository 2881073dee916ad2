// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FrameThumbnails_h
#define sensornoise_moments_FrameThumbnails_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "base/PixelLayout.h"
#include "moments/Constants.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

/** \file
 * Thumbnails of the frames, and the frames that are unlike the others by them. */

namespace sensornoise
{

/** Change of the scene from frame to frame, without flicker and noise. It is computed from the median cell, as if the
 * differences were normally distributed, so that objects that cross a smaller part of the frame have little effect.
 * The values are medians over the frames. */
struct SensorNoise_EXPORT SceneChange
{
  double fraction{ 0.0 };   ///< fraction of the variance over the cells of a frame, at most 1 [1]
  double ofTheLevel{ 0.0 }; ///< square root of the changed variance over the mean level of the frames [1]

  /** Returns whether the frames do not show one static scene. */
  bool
  IsLarge() const;
};

/** How much the mean of a cell changes over time. */
struct CellVariance
{
  std::size_t pixel{ 0 }; ///< a pixel in the middle of the cell
  /** Variance of the mean over time, times the number of its pixels: the variance of the pixels, if their changes are
   * independent [DN^2]. */
  double perPixelDn2{ 0.0 };
};

/** \class FrameThumbnails
 * \brief Means of each frame over up to 16 x 16 cells, from which it is tested whether all frames show one scene.
 *
 * In a static scene the cells of a frame follow the cells of the mean frame, except for flicker, a level, noise, and
 * local changes of the illumination. This fails if the stack runs along another axis than time, if the scene changes,
 * or if the camera moves by many pixels. Two rows of each cell are sampled. */
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
  /** Adds frames first ... first + count - 1, whose pixels lie as \a layout specifies. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *      frames,
            const PixelLayout & layout,
            std::size_t         first,
            std::size_t         count,
            const ParallelFor & parallelFor);

  /** Writes the means, the noise and the fractions of uniform cells, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Reads thumbnails of other frames, written by Save(). Throws std::runtime_error if the stream ends early. */
  FrameThumbnails
  ReadOther(std::istream & in) const;
  /** Adds the frames of \a other, which were not added here. */
  void
  Merge(const FrameThumbnails & other);

  /** Returns the change of the scene over the \a frames, after all frames have been added; 0 if fewer than 5 frames or
   * 9 cells are usable. */
  SceneChange
  FindChange(const std::vector<std::size_t> & frames) const;

  /** Returns how much the means of the finite cells change over the \a frames, without the factor and the level of each
   * frame; empty if fewer than 5 frames or 9 cells are usable. */
  std::vector<CellVariance>
  FindCellVariances(const std::vector<std::size_t> & frames) const;

  /** Returns the relative standard deviation of the illumination factor over the \a frames [1], see
   * ComputeIlluminationChange(). All frames must have been added. Returns 0 if fewer than 5 frames or 9 cells are
   * usable. */
  double
  FindIlluminationChange(const std::vector<std::size_t> & frames) const;

  /** Returns the thumbnails of some \a frames, in this order. */
  FrameThumbnails
  Of(const std::vector<std::size_t> & frames) const;

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
  /** Returns the mean number of sampled pixels of a cell that has any. */
  double
  PixelsOfCell() const;
  /** Mean of a cell in frame \a t [DN]; NaN: it has no finite pixel. */
  double
  MeanOf(std::size_t t, std::size_t cell) const
  {
    return m_Means[t * m_Cells + cell];
  }
  /** Returns the means of \a cells in frame \a t [DN]. */
  std::vector<double>
  MeansOf(std::size_t t, const std::vector<std::size_t> & cells) const;
  /** Returns, for each cell, whether all of its sampled pixels are nonzero in \a mask, of a frame's size. */
  std::vector<bool>
  FindCellsWithin(const std::vector<std::uint8_t> & mask) const;
  /** Variance of the means of the cells in frame \a t, estimated from the differences of neighbouring pixels: noise and
   * texture [DN^2]. */
  double
  NoiseOf(std::size_t t) const
  {
    return m_Noise[t];
  }
  /** Fraction of the cells of frame \a t in which no two neighbours differ [1]. */
  double
  UniformFractionOf(std::size_t t) const
  {
    return m_UniformFractions[t];
  }

private:
  /** The cells that are finite in all frames, and their means over the frames [DN]; empty if frames or cells are too
   * few. */
  struct MeanFrame
  {
    std::vector<std::size_t> cells;
    std::vector<double>      means;
  };

  MeanFrame
  FindMeanFrame(const std::vector<std::size_t> & frames) const;

  /** Returns the number of sampled pixels of each cell. */
  std::vector<double>
  PixelsOfCells() const;

  /** A part of a row of a cell. */
  struct Run
  {
    std::size_t cell;
    std::size_t begin; ///< range of pixels of a frame
    std::size_t end;
  };

  std::size_t               m_Pixels;
  std::size_t               m_Frames;
  std::size_t               m_Cells;
  std::vector<Run>          m_Runs;
  std::vector<std::uint8_t> m_Mask;
  std::vector<double>       m_Means; // means of the cells, frame by frame [DN]; NaN: no finite pixel
  std::vector<double>       m_Noise; // variance of these means by noise and texture, mean over the cells [DN^2]
  std::vector<double>       m_UniformFractions;
};

/** Fit of a frame by a level plus a factor times the mean frame, from its means over cells. */
struct FrameFit
{
  double centre{ 0.0 };     ///< mean over the cells of the mean frame [DN]
  double level{ 0.0 };      ///< mean over the cells of the frame [DN]
  double factor{ 0.0 };     ///< factor of the mean frame [1]
  double meanSquare{ 0.0 }; ///< mean square over the cells of the deviation from the fit [DN^2]

  /** Returns the deviation of a cell from the fit [DN]. */
  double
  DifferenceOf(double mean, double frame) const
  {
    return frame - level - factor * (mean - centre);
  }
};

/** Fits the cells \a used of \a frame to \a mean by least squares [DN]. */
SensorNoise_EXPORT FrameFit
FitCells(const std::vector<double> & mean, const std::vector<double> & frame, const std::vector<std::size_t> & used);

/** Fits all cells, then again without the fraction InMoments.fewCells of them that deviates most. */
SensorNoise_EXPORT FrameFit
FitMostCells(const std::vector<double> & mean, const std::vector<double> & frame);

/** Returns the numbers 0 ... count - 1. */
SensorNoise_EXPORT std::vector<std::size_t>
AllBelow(std::size_t count);

/** Returns the relative standard deviation over time of the illumination factor of frames [1], from the means of each
 * frame over some cells.
 *
 * \a frames holds the cells of each frame [DN], \a mean the same cells of the mean frame [DN]. Under another
 * illumination a frame is the mean frame times a factor, plus a level. Where the cells differ enough, this factor is
 * the illumination factor, for any offset. In a flat field the factor is not identifiable, but the change of the level
 * is. It counts as InMoments.strongIlluminationChange where its variance is InMoments.strongChangeOfFlat times
 * \a noiseDn2, an upper bound of the noise variance of the pixels [DN^2]. A frame counts as unchanged if most of its
 * difference from the mean frame is neither a level nor a factor, but noise or another scene. */
SensorNoise_EXPORT double
ComputeIlluminationChange(const std::vector<double> &              mean,
                          const std::vector<std::vector<double>> & frames,
                          double                                   noiseDn2);

class FrameThumbnails;

/** Finds the frames that are unlike the others, in ascending order. The list is empty if fewer than MinimumFrames would
 * be left, or if more than a fifth of the frames with content are unlike.
 *
 * A frame of the burst is a level plus a factor times the mean frame, except for noise, vibration and local changes of
 * the illumination. These are as large in the other frames. A dark frame has the factor 0: it belongs to the burst.
 * Estimator.md, 3.1. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
FindUnlikeFrames(const FrameThumbnails & thumbnails);

/** Joins the unlike frames of several parts of \a frames, such as the planes of a mosaic. The list is empty if the
 * unlike frames with content are more than the fraction \a largestFraction [1], or if fewer than MinimumFrames would be
 * left. */
SensorNoise_EXPORT std::vector<LeftOutFrame>
JoinUnlikeFrames(const std::vector<std::vector<LeftOutFrame>> & ofParts,
                 std::size_t                                    frames,
                 double                                         largestFraction = InMoments.largestLeftOutFraction);

/** Returns the numbers of the frames. */
SensorNoise_EXPORT std::vector<std::size_t>
NumbersOf(const std::vector<LeftOutFrame> & frames);

} // namespace sensornoise

#endif
