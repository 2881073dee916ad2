// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseResiduals_h
#define sensornoise_correlation_NoiseResiduals_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StepResults.h"
#include "correlation/Constants.h"
#include "correlation/FrameSample.h"
#include "correlation/FrameTimes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \class UnequalFrames
 * \brief Noise that is stronger in bright frames: V_t = V + g gamma_t q for a pixel of signal q.
 *
 * White noise of the covariance V I + g q Gamma, Gamma = diag(gamma_t), has after the projection P
 *
 *     E[sum_t r_t r_(t+d)] = V sum_t P_(t,t+d) + g q N_d,   N_d = sum_t (P Gamma P)_(t,t+d).
 *
 * The second term is no correlation between frames. Without gamma all frames have equal noise. Estimator.md, 3.12. */
class SensorNoise_EXPORT UnequalFrames
{
public:
  UnequalFrames() = default;
  /** \a gamma is the relative change of the illumination in each frame [1]; values below -1 count as -1. \a gain is the
   * slope of the variance [DN/e-]. \a offsetDn is the dark offset at which gamma was estimated, above the level from
   * which the signal is measured [DN]. */
  UnequalFrames(const std::vector<double> & gamma, double gain, double offsetDn);

  /** Returns whether all frames have equal noise. */
  bool
  AreEqual() const
  {
    return m_Gamma.size() == 0;
  }
  const Eigen::VectorXd &
  GetGamma() const
  {
    return m_Gamma;
  }
  /** Returns the slope of the variance [DN/e-]. */
  double
  GetGain() const
  {
    return m_Gain;
  }
  /** Returns the dark offset above the level from which the signal is measured [DN]. */
  double
  GetOffsetDn() const
  {
    return m_OffsetDn;
  }
  /** Leaves out all but the last frames. */
  void
  KeepLast(Eigen::Index frames);
  /** Leaves out all but the first frames. */
  void
  KeepFirst(Eigen::Index frames);

  /** Returns N_d for d = 0 ... lags, for the projection on the complement of an orthonormal \a basis, frames x series,
   * of frames at \a times; 0 where frames have equal noise. */
  Eigen::VectorXd
  Autocovariance(const Eigen::MatrixXd & basis, std::size_t lags, const FrameTimes & times = {}) const;

private:
  Eigen::VectorXd m_Gamma;
  double          m_Gain{ 0.0 };
  double          m_OffsetDn{ 0.0 };
};

/** Periodic interference: a sine wave across the frame, whose amplitude and phase are free in each tile of each frame.
 * Estimator.md, 3.12. */
struct PeriodicInterference
{
  WaveFrequency  frequency;
  MeasuredNumber varianceDn2; ///< mean square of the wave [DN^2]
};

/** Returns the mean of the numbers that are not NaN, one from each tile, with the standard error by their scatter; 0
 * from fewer than two. */
SensorNoise_EXPORT MeasuredNumber
MeanOfTiles(std::vector<double> numbers);

/** Properties of the pixels of a frame whose noise is sampled. */
struct SampledPixels
{
  const std::vector<double> &       mean;                 ///< mean of each pixel, or of its neighbours [DN]
  const std::vector<std::uint8_t> & take;                 ///< 1: static and not clipped
  double                            blackDn{ 0.0 };       ///< black level, from which the signal is measured [DN]
  bool                              isBlackKnown{ true }; ///< false: \a blackDn is a lower bound only
};

/** Returns the level from which the signal is measured where the dark offset is not known [DN]. This is the darkest
 * level if it is near \a blackDn, a lower bound of the offset, else \a blackDn itself. Covariances in proportion to
 * the variance are then proportional to the signal above a level below the true offset. */
inline double
ZeroOfSignal(double darkestDn, double brightestDn, double blackDn)
{
  return darkestDn - blackDn < InCorrelation.darkFraction * (brightestDn - blackDn) ? darkestDn : blackDn;
}

/** \class NoiseResiduals
 * \brief Noise of the sampled pixels: what remains when the temporal components of the scene are projected out.
 *
 * r = P u with P = I - Q Q', where Q spans the constant and the series. For noise that is white in time,
 *
 *     E[sum_t r_t(p) r_t(q)] = C_pq tr P. */
class SensorNoise_EXPORT NoiseResiduals
{
public:
  /** Number of intensity bins of equal count in which covariances are summed. Four bins distinguish a constant, a line
   * and a parabola. */
  static constexpr std::size_t IntensityBins = 4;

  /** Projects \a series, frames x series, out of every pixel. The series are of all frames or of the frames of the
   * sample. Takes the sample's memory. */
  NoiseResiduals(NoiseSample             sample,
                 const Eigen::MatrixXd & series,
                 const SampledPixels &   pixels,
                 const ParallelFor &     parallelFor);
  /** Projects a sample of frames, after the means of its pixels are subtracted. Each tile is processed while it is in
   * the cache. */
  NoiseResiduals(FrameSample             sample,
                 const Eigen::MatrixXd & series,
                 const SampledPixels &   pixels,
                 const ParallelFor &     parallelFor);

  /** Uses other pixels: all whose \a take is not 0. Recomputes weights and bins. */
  void
  Take(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  /** Subtracts the noise and illumination that are common to the pixels of a line, a row or a column, in a frame.
   *
   * In each frame, each line through a row of tiles is regressed on 1 and the signal, over the pixels of \a take. This
   * removes all illumination that is specific to a line, whatever the dark offset, and the noise of whole lines. It
   * reduces a pixel's variance by the pixel's leverage h, so that all values of the pixel are divided by sqrt(1 - h):
   * its variance is unchanged. Returns 1 - h of the pixels, tile by tile [1]; 0 where that is below
   * InCorrelation.leastLeftOfLine, or where the line has no pixel of \a take. Estimator.md, 3.18. */
  std::vector<float>
  SubtractLines(LineAxis axis, const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  /** Subtracts a sine wave of this frequency from each tile of each frame, by least squares over the
   * pixels that are used. Their values are divided by sqrt(1 - h) as in SubtractLines(), and the weights and bins are
   * computed again. */
  void
  SubtractWave(const WaveFrequency & frequency, const ParallelFor & parallelFor);
  /** Returns the waves that were subtracted. */
  const std::vector<PeriodicInterference> &
  GetInterference() const
  {
    return m_Interference;
  }
  /** Returns values a_k of the pixels of tile \a i [DN]. By the subtraction of waves white noise has the covariance
   * -sum a_k a_k' between the residuals of two pixels of a frame. */
  std::vector<const float *>
  WaveProjectionsOf(std::size_t i) const
  {
    std::vector<const float *> projections;
    for (const std::vector<float> & projection : m_WaveProjections)
    {
      projections.push_back(projection.data() + i * this->GetTiles().Pixels());
    }
    return projections;
  }

  /** Sets the noise that differs from frame to frame. \a frames describes all frames of the stack; the sample contains
   * the first frames of them. Default: all frames have equal noise. */
  void
  SetUnequalFrames(UnequalFrames frames);
  const UnequalFrames &
  GetUnequalFrames() const
  {
    return m_Unequal;
  }

  /** Sets the times of the frames of the sample. Default: all frames are neighbours in time. */
  void
  SetTimes(FrameTimes times)
  {
    m_Times = std::move(times);
  }
  const FrameTimes &
  GetTimes() const
  {
    return m_Times;
  }

  /** Leaves out the first frames, which a recursive filter filters less than the others: it cannot filter its first
   * frame. The typical variance is not computed again. */
  void
  DropFirst(std::size_t frames, const ParallelFor & parallelFor);

  const SampleTiles &
  GetTiles() const
  {
    return m_Sample.GetTiles();
  }
  /** Returns the residuals of tile \a i, in the order of NoiseSample [DN]. */
  const float *
  OfTile(std::size_t i) const
  {
    return m_Sample.OfTile(i);
  }
  /** Returns the index in the frame of pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p) const
  {
    return m_Sample.PixelOf(i, p);
  }
  /** Returns the signal of the pixels of tile \a i [DN above black]. */
  const float *
  SignalOf(std::size_t i) const
  {
    return m_Signal.data() + i * this->GetTiles().Pixels();
  }
  /** Returns the inverse of the typical noise variance at the signal of each pixel of tile \a i [1/DN^2]; 0: the pixel
   * is left out. */
  const float *
  WeightOf(std::size_t i) const
  {
    return m_Weight.data() + i * this->GetTiles().Pixels();
  }
  /** Returns the sums over the frames of the squared residuals of tile \a i [DN^2]. */
  const float *
  SquaresOf(std::size_t i) const
  {
    return m_Variance.data() + i * this->GetTiles().Pixels();
  }
  /** Returns the change of the mean level of tile \a i in every frame that was projected out, from the mean over the
   * frames, for the pixels of the constructor [DN]. It is for all frames; DropFirst() must not have been called. */
  Eigen::VectorXd
  LevelChangesOf(std::size_t i) const;
  /** Returns the axis along which SubtractLines() was called, if it was. White noise then has the covariance -(a a' + b
   * b') between the residuals of two pixels of a line in a frame. Here a and b are the values of LineProjectionsOf() at
   * both pixels [DN]. */
  const std::optional<LineAxis> &
  GetSubtractedLines() const
  {
    return m_SubtractedLines;
  }
  /** Returns the values a and b of the pixels of tile \a i, see GetSubtractedLines() [DN]. */
  std::array<const float *, 2>
  LineProjectionsOf(std::size_t i) const
  {
    const std::size_t first = i * this->GetTiles().Pixels();
    return { m_LineProjections[0].data() + first, m_LineProjections[1].data() + first };
  }
  /** Returns the intensity bins of the pixels of tile \a i. */
  const std::uint8_t *
  BinOf(std::size_t i) const
  {
    return m_Bin.data() + i * this->GetTiles().Pixels();
  }
  /** Returns the mean signal with the squared inverse variances w^2 as weights [DN]. A pixel of the signal z
   * contributes w^2 (z - mean)^2 to the information on the slope of the variance. */
  double
  GetMeanSignal() const
  {
    return m_MeanSignal;
  }
  /** Returns the orthonormal basis Q, frames x (1 + series). */
  const Eigen::MatrixXd &
  GetBasis() const
  {
    return m_Basis;
  }
  /** Returns the degrees of freedom, tr P. */
  double
  GetDof() const
  {
    return static_cast<double>(m_Basis.rows() - m_Basis.cols());
  }
  /** Returns the level from which the signal is measured [DN]. */
  double
  GetBlackDn() const
  {
    return m_BlackDn;
  }
  bool
  IsBlackKnown() const
  {
    return m_IsBlackKnown;
  }
  /** Returns a lower bound of the signal [DN]: 0 where black is known, else the signal of the darkest pixels. */
  double
  GetLeastSignal() const
  {
    return m_IsBlackKnown ? 0.0 : m_DarkestSignal;
  }
  /** Returns the number of pixels that are used. */
  std::size_t
  GetNumberOfPixels() const
  {
    return m_Pixels;
  }
  /** Returns whether there are enough tiles and pixels to measure the noise correlation. */
  bool
  HasEnoughPixels() const;

private:
  /** Sets the signal and projects every tile. \a fillTile(i) writes the values of a tile before that. */
  template <typename TFillTile>
  void
  Project(const SampledPixels & pixels, const ParallelFor & parallelFor, TFillTile fillTile);
  /** Projects the series out of tile \a i. Returns the coordinates of its pixels on them, series by series [DN]. */
  std::vector<float>
  ProjectTile(std::size_t i);
  void
  SumSquares(std::size_t i);
  /** Does the regression of SubtractLines() for line \a line of \a tiles, without the final scaling. Stores the
   * projections on the line, and in \a left the fraction of each pixel's variance that remains. */
  void
  RegressLines(LineAxis axis, const std::vector<std::size_t> & tiles, std::size_t line, std::vector<float> & left);
  /** Does the regression of SubtractWave() in tile \a i, and stores its two projections in \a projections. Returns the
   * mean square of the wave [DN^2]; NaN if the tile has too few pixels. */
  double
  SubtractWaveOfTile(std::size_t i, const WaveFrequency & frequency, const std::array<float *, 2> & projections);
  /** Sets the weights by averaging the variance along the signal, and the intensity bins. */
  void
  Weigh(const std::vector<std::uint8_t> & take);

  NoiseSample               m_Sample;
  Eigen::MatrixXd           m_Basis;
  Eigen::MatrixXd           m_MeanCoordinates; // means over the pixels of a tile, series x tiles [DN]
  std::vector<float>        m_Signal;
  std::vector<float>        m_Variance; // sums over time of the squares
  std::vector<float>        m_Weight;
  std::vector<std::uint8_t> m_Bin;
  double                    m_MeanSignal{ 0.0 };
  std::size_t               m_Pixels{ 0 };
  double                    m_BlackDn{ 0.0 };
  bool                      m_IsBlackKnown{ true };
  double                    m_DarkestSignal{ 0.0 };
  UnequalFrames             m_Unequal;
  FrameTimes                m_Times;
  std::optional<LineAxis>   m_SubtractedLines;
  /** LineProjectionsOf() for all tiles; empty: no lines were subtracted. */
  std::array<std::vector<float>, 2> m_LineProjections;
  std::vector<PeriodicInterference> m_Interference;
  std::vector<std::vector<float>>   m_WaveProjections; // WaveProjectionsOf() for all tiles, two for each wave
};

/** Returns the pixels whose \a take is not 0 in the order of their signal \a signal, which must be finite. Pixels of
 * equal signal are in the order of their index. */
SensorNoise_EXPORT std::vector<std::uint32_t>
SortPixelsBySignal(const std::vector<float> & signal, const std::vector<std::uint8_t> & take);

} // namespace sensornoise

#endif
