// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_FlickerSums_h
#define sensornoise_published_FlickerSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "base/PixelLayout.h"
#include "published/IsoIntensitySet.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class FlickerSums
 * \brief Sums of each frame over the bright and the dark set, all that flicker and offset are estimated from.
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. For every frame t, with v = u / ubar (3.2) and the weights
 * of Remark 1:
 * - v^*(t), (3.8), and v_*(t), (3.14), with the spread of the pixels about them;
 * - if asked for, the sum of w v over the row set in each row y, for (3.28).
 *
 * Rows are those that the shutter sees: columns of the frame where it travels along x, see FrameGeometry.
 * Frames are independent: each is added once, whole, by one thread, so that chunks and threads change no bit.
 * Memory: 32 bytes a frame, 8 bytes a frame and row, plus the sets.
 */
class SensorNoise_EXPORT FlickerSums
{
public:
  /** \a mean is the frame-sized map of temporal means [DN]. Without a \a rowSet there are no sums by row. */
  FlickerSums(const IsoIntensitySet & bright,
              const IsoIntensitySet & dark,
              const double *          mean,
              const FrameGeometry &   geometry,
              std::size_t             frames,
              const IsoIntensitySet & rowSet = {});

  /** The pixels of the frames to come stand as \a layout says; without it, one after the other. To be told once. */
  void
  SetLayout(const PixelLayout & layout);

  /** Adds frame \a t. Different frames may be added at the same time. */
  template <typename TPixel>
  void
  AddFrame(const TPixel * frame, std::size_t t);

  /** No frame has been added: all sums are 0. */
  void
  Forget();

  /** Writes the sums of the frames, see BinaryStream; those of a frame that was not added are 0. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums of other frames from a stream. Throws std::runtime_error, and changes nothing, if it ends early. */
  void
  Merge(std::istream & in);

  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** v^*(t), (3.8): the mean of u / ubar over S^*. */
  double
  GetBrightRatio(std::size_t t) const
  {
    return m_BrightRatios[t];
  }

  /** v_*(t), (3.14): the mean of u - v^*(t) ubar over S_* [DN]. */
  double
  GetDarkResidualDn(std::size_t t) const
  {
    return m_DarkResiduals[t];
  }

  /** Variance that pixel noise gives to v^*(t) [1], and to v_*(t) with v^*(t) held [DN^2].
   *
   * From the spread of the pixels within each frame, which flicker, being common to them, does not touch. */
  double
  GetBrightRatioNoise() const
  {
    return m_Bright.NoiseOfAverage(m_BrightSpreads);
  }
  double
  GetDarkResidualNoiseDn2() const
  {
    return m_Dark.NoiseOfAverage(m_DarkSpreads);
  }

  /** 0 without a row set. */
  std::size_t
  GetNumberOfRows() const
  {
    return m_Rows;
  }

  /** Sum of the weights of the row set in \a row; over all rows it is 1. */
  double
  GetRowWeight(std::size_t row) const
  {
    return m_RowWeights[row];
  }

  /** Sum of w v over the row set in \a row of frame \a t. */
  double
  GetRowSum(std::size_t t, std::size_t row) const
  {
    return m_RowSums[t * m_Rows + row];
  }

private:
  /** A set with the means of its pixels. */
  struct WeightedPixels
  {
    WeightedPixels(const IsoIntensitySet & set, const double * mean);

    /** Calls function(first, count, values) for the runs of pixels, one after the other, with their values: value(u,
     * mean). */
    template <typename TPixel, typename TValue, typename TFunction>
    void
    ForRunsOf(const TPixel * frame, TValue value, TFunction function) const;

    /** Weighted average and variance over the set of \a value(u, mean). */
    template <typename TPixel, typename TValue>
    void
    Average(const TPixel * frame, TValue value, double & average, double & spread) const;

    /** With q = sum w^2 the spread has the expectation (1 - q) N, and the average the variance q N. */
    double
    NoiseOfAverage(const std::vector<double> & spreads) const;

    std::vector<std::uint32_t> pixels; // where they stand in the frame
    std::vector<double>        weights;
    std::vector<double>        means;
    double                     effectivePixels;
  };

  /** All that is made of frames. */
  std::array<std::vector<double> *, 5>
  OfFrames()
  {
    return { &m_BrightRatios, &m_DarkResiduals, &m_BrightSpreads, &m_DarkSpreads, &m_RowSums };
  }

  std::size_t                m_Frames;
  std::size_t                m_Width;
  std::size_t                m_Rows;
  std::vector<double>        m_BrightRatios;
  std::vector<double>        m_DarkResiduals;
  std::vector<double>        m_BrightSpreads;
  std::vector<double>        m_DarkSpreads;
  std::vector<double>        m_RowSums;
  std::vector<double>        m_RowWeights;
  WeightedPixels             m_Bright;
  WeightedPixels             m_Dark;
  WeightedPixels             m_RowSet;
  std::vector<std::uint32_t> m_RowOf; // of each pixel of the row set
};

} // namespace sensornoise

#endif
