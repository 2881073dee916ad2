// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_Flicker_h
#define sensornoise_published_Flicker_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "base/PixelLayout.h"
#include "published/PublishedScene.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class FlickerSums
 * \brief Sums of each frame over the bright and the dark set, from which flicker and offset are estimated.
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. For every frame t, with v = u / ubar (3.2) and the weights
 * of Remark 1:
 * - v^*(t), (3.8), and v_*(t), (3.14), with the variance of the pixels about them;
 * - if requested, the sum of w v over the row set in each row y, for (3.28).
 *
 * Rows are the lines of pixels that are exposed at one time: columns of the frame if the shutter travels along x, see
 * FrameGeometry. Frames are independent: one thread adds each frame once and as a whole, so that the number of chunks
 * and threads does not change a bit. Memory: 32 bytes per frame, 8 bytes per frame and row, and the sets. */
class SensorNoise_EXPORT FlickerSums
{
public:
  /** \a mean is the map of temporal means [DN]. Without a \a rowSet there are no sums by row. */
  FlickerSums(const IsoIntensitySet & bright,
              const IsoIntensitySet & dark,
              const double *          mean,
              const FrameGeometry &   geometry,
              std::size_t             frames,
              const IsoIntensitySet & rowSet = {});

  /** Sets the layout of the pixels of all frames; without it they are adjacent. To be called at most once, before the
   * first frame. */
  void
  SetLayout(const PixelLayout & layout);

  /** Adds frame \a t. Different frames may be added at the same time. */
  template <typename TPixel>
  void
  AddFrame(const TPixel * frame, std::size_t t);

  /** Sets all sums to 0. */
  void
  Forget();

  /** Writes the sums of the frames, see BinaryStream. The sums of frames that were not added are 0. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums of other frames from a stream. Throws std::runtime_error, and changes nothing, if the stream ends
   * early. */
  void
  Merge(std::istream & in);

  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** Returns v^*(t), (3.8): the mean of u / ubar over S^* [1]. */
  double
  GetBrightRatio(std::size_t t) const
  {
    return m_BrightRatios[t];
  }

  /** Returns v_*(t), (3.14): the mean of u - v^*(t) ubar over S_* [DN]. */
  double
  GetDarkResidualDn(std::size_t t) const
  {
    return m_DarkResiduals[t];
  }

  /** Returns the variance of v^*(t) by pixel noise [1]. It is measured by the dispersion of the pixels within each
   * frame, which flicker does not change because it is common to them. */
  double
  GetBrightRatioNoise() const
  {
    return m_Bright.NoiseOfAverage(m_BrightVariances);
  }
  /** Returns the variance of v_*(t) by pixel noise for a given v^*(t) [DN^2], measured in the same way. */
  double
  GetDarkResidualNoiseDn2() const
  {
    return m_Dark.NoiseOfAverage(m_DarkVariances);
  }

  /** Returns the number of rows; 0 without a row set. */
  std::size_t
  GetNumberOfRows() const
  {
    return m_Rows;
  }

  /** Returns the sum of the weights of the row set in \a row; the sum over all rows is 1. */
  double
  GetRowWeight(std::size_t row) const
  {
    return m_RowWeights[row];
  }

  /** Returns the sum of w v over the row set in \a row of frame \a t. */
  double
  GetRowSum(std::size_t t, std::size_t row) const
  {
    return m_RowSums[t * m_Rows + row];
  }

private:
  /** Iso-intensity set with the means of its pixels. */
  struct WeightedPixels
  {
    WeightedPixels(const IsoIntensitySet & set, const double * mean);

    /** Calls function(first, count, values) for runs of pixels, where the values are value(u, mean). */
    template <typename TPixel, typename TValue, typename TFunction>
    void
    ForRunsOf(const TPixel * frame, TValue value, TFunction function) const;

    /** Computes the weighted average and variance of \a value(u, mean) over the set. */
    template <typename TPixel, typename TValue>
    void
    Average(const TPixel * frame, TValue value, double & average, double & spread) const;

    /** Returns the variance of the average. With q = sum w^2 and the noise N of a pixel, \a spreads have the
     * expectation (1 - q) N, and the average has the variance q N. */
    double
    NoiseOfAverage(const std::vector<double> & spreads) const;

    std::vector<std::uint32_t> pixels; // place in the frame
    std::vector<double>        weights;
    std::vector<double>        means;
    double                     effectivePixels; // 1 / sum of the squared weights
  };

  /** Returns all numbers that are computed from frames. */
  std::array<std::vector<double> *, 5>
  OfFrames()
  {
    return { &m_BrightRatios, &m_DarkResiduals, &m_BrightVariances, &m_DarkVariances, &m_RowSums };
  }

  std::size_t                m_Frames;
  std::size_t                m_Width;
  std::size_t                m_Rows;
  std::vector<double>        m_BrightRatios;
  std::vector<double>        m_DarkResiduals;
  std::vector<double>        m_BrightVariances;
  std::vector<double>        m_DarkVariances;
  std::vector<double>        m_RowSums;
  std::vector<double>        m_RowWeights;
  WeightedPixels             m_Bright;
  WeightedPixels             m_Dark;
  WeightedPixels             m_RowSet;
  std::vector<std::uint32_t> m_RowOf; // row of each pixel of the row set
};

/** v^*(y, t) of every frame and row, (3.28), where the row set has pixels. */
struct RowRatios
{
  double                    sigmaRows{ 0.0 }; ///< sigma_y [rows]
  std::vector<double>       ratio;            ///< row by row for each frame [1]; 1 where not known
  std::vector<std::uint8_t> known;            ///< for each row, 1: the row set has pixels within sigma_y
};

/** Chooses sigma_y [rows] by leave-one-row-out cross-validation; 0 means that the flicker is the same in all rows.
 *
 * Section 3.5 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035) uses 50 rows and leaves the choice to future
 * work. Here v^* of each row is predicted from the other rows with the weights of (3.28), and the sigma_y of the best
 * prediction over all frames is chosen. It must reduce the squared error by more than 1 % compared with v^* of the
 * whole frame. Below this limit, the flicker of single rows adds less than 1 % of the noise to the variance of a pixel.
 * A first test on 16 frames and three widths saves the search for stacks without row flicker. */
SensorNoise_EXPORT double
ChooseSigmaRows(const FlickerSums & sums);

/** Computes v^*(y, t) with the width \a sigmaRows [rows]. A row that is farther than sigma_y from all pixels of the row
 * set is not known, because the kernel would extrapolate. */
SensorNoise_EXPORT RowRatios
SmoothRowRatios(const FlickerSums & sums, double sigmaRows);

/** Returns the mean of at least 1 value. */
SensorNoise_EXPORT double
Mean(const std::vector<double> & values);

/** Returns the unbiased variance of at least 2 values. */
SensorNoise_EXPORT double
SampleVariance(const std::vector<double> & values);

/** Computes K, mu and gamma_t from the sums over S^* and S_*, (3.8) to (3.17); with \a mode also gamma_t(y), (3.28).
 *
 * K is the slope of the ordinary regression of v_* on v^* - 1. Both have mean 0 by construction. K and mu always come
 * from the whole frames, as in section 3.5 of the paper. \a sigmaRows is sigma_y [rows] for RollingShutter::Fixed. */
SensorNoise_EXPORT FlickerEstimate
EstimateFlicker(const FlickerSums &     sums,
                const IsoIntensitySet & bright,
                const IsoIntensitySet & dark,
                RollingShutter          mode,
                double                  sigmaRows);

/** \class CorrectedVariance
 * \brief Temporal variance of the flicker-corrected stack u^ = u - (1 + gamma_t)(ubar - mu), (3.18), computed without
 * u^.
 *
 * With the centred flicker c_t = gamma_t(y) - mean over t, P = sum c_t^2 and C = sum c_t u, the sum of squares of u^
 * about its mean is
 *
 *     M - 2 (ubar - mu) C + (ubar - mu)^2 P,
 *
 * where M is the sum of squares of u about its mean: (3.18) expanded. So one more pass over the stack, which sums one
 * number C per pixel, replaces the corrected stack of (3.24).
 *
 * The centred flicker is rounded to multiples of a power of 2, with the bits that the sums over all frames leave of a
 * double's 53 (30 bits for 100 frames). With integer pixels, the order of frames and parts of the stack therefore does
 * not change a bit. Floating-point frames are added one by one in the order of time. Pixels of rows whose flicker is
 * not known get NaN.
 *
 * Memory: 8 bytes per pixel, and 8 bytes per frame and row. */
class SensorNoise_EXPORT CorrectedVariance
{
public:
  /** Prepares the sums, all 0, for \a frames frames with the flicker and offset of \a flicker. */
  CorrectedVariance(const FlickerEstimate & flicker,
                    const FrameGeometry &   geometry,
                    std::size_t             frames,
                    const ParallelFor &     parallelFor = SerialFor);

  /** Adds row \a y of \a count frames from frame \a t on. The frames lie in \a frames as \a layout describes. Different
   * rows may be added at the same time. */
  template <typename TPixel>
  void
  AddRow(const TPixel * frames, const PixelLayout & layout, std::size_t count, std::size_t t, std::size_t y);

  /** Sets all sums to 0. */
  void
  Forget();

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums over other frames from a stream. Throws std::runtime_error, and changes nothing, if the stream ends
   * early. */
  void
  Merge(std::istream & in);

  /** Returns the unbiased variance of u^ at pixel \a p from the mean and the squared deviations of u [DN^2]; NaN if the
   * flicker of its row is not known. */
  double
  GetVariance(std::size_t p, double meanDn, double sumOfSquaredDeviationsDn2) const;

private:
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  double                    m_OffsetDn;
  std::size_t               m_Rows; // number of rows along the shutter's axis; 1: one flicker for the whole frame
  std::vector<double>       m_Cross;
  std::vector<double>       m_Series;
  std::vector<double>       m_SeriesSums; // nonzero by rounding alone
  std::vector<double>       m_SeriesSquares;
  std::vector<std::uint8_t> m_Known;
};

} // namespace sensornoise

#endif
