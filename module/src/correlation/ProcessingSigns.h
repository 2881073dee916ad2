// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_ProcessingSigns_h
#define sensornoise_correlation_ProcessingSigns_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseResiduals.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

/** \file
 * Signs that frames were processed: the kurtosis of the noise, and a covariance that depends on the position. */

namespace sensornoise
{

/** \struct KurtosisSums
 * \brief Sums for the excess kurtosis of the noise and of its differences between neighbours, and for its upper tail.
 *
 * A linear filter leaves normal noise normal. A non-linear step does not: a median, the correction of supposed
 * defects, or coarse quantization of blocks. Second moments cannot detect it. Each series is scaled by itself, so that
 * pixels of unequal variance do not look like long tails:
 *
 *     K = sum_t r^4 / (sum_t r^2)^2,   for normal noise E[K] = 3 sum_t P_tt^2 / (n (n + 2)) with n = tr P, exactly. */
struct SensorNoise_EXPORT KurtosisSums
{
  /** Number of kinds of series: the pixel; its differences from the right and the lower neighbour; the alternating sums
   * of 2 x 2, of 8 x 1 and of 1 x 8 pixels. */
  static constexpr std::size_t Kinds = 6;

  std::array<double, Kinds> series{}; ///< number of series
  std::array<double, Kinds> ratio{};  ///< sum of K over its expectation for normal noise

  double values{ 0.0 }; ///< number of residuals that were compared with InCorrelation.tailBegins
  double inTail{ 0.0 }; ///< number of compared residuals above it

  KurtosisSums &
  operator+=(const KurtosisSums & other);
  /** Returns the excess kurtosis [1]; 0 without series. */
  double
  Excess(std::size_t kind) const
  {
    return series[kind] > 0.0 ? 3.0 * (ratio[kind] / series[kind] - 1.0) : 0.0;
  }
  /** Returns the fraction of the residuals that lie in the upper tail, relative to normal noise, minus 1 [1]; 0 without
   * residuals. Few electrons make it positive. Where outliers are removed it is -1. */
  double
  UpperTailExcess() const;
  /** Returns the significance of a deficit in the upper tail, in standard deviations of a normal distribution: the
   * root of the deviance of a Poisson distribution; 0 without a deficit. */
  double
  SignificanceOfDeficit() const;
};

/** Returns the expected K of normal noise with the same variance in all frames. */
SensorNoise_EXPORT double
NormalKurtosis(const NoiseResiduals & residuals);

/** Returns E[sum_t r_t^4 / (sum_t r_t^2)^2] for normally distributed r with a \a covariance. It is exact, as an
 * integral over s from 0:
 *
 *     3 int s |1 + 2 s S|^(-1/2) sum_t m_t(s)^2 ds,   m(s) the diagonal of S (1 + 2 s S)^(-1),
 *
 * where 1/a^2 = int s exp(-s a) ds is used, and the factor exp(-s r'r) turns the distribution of r into a normal
 * distribution of smaller covariance. */
SensorNoise_EXPORT double
KurtosisOfNormal(const Eigen::MatrixXd & covariance);

/** \class MixtureKurtosis
 * \brief The kurtosis K of KurtosisSums for normal noise whose variance differs from frame to frame.
 *
 * Frames of different variances are a mixture. Its tails are longer than the tails of one normal distribution, also
 * without any non-linear processing. K depends on the fraction b of a pixel's variance that is shot noise. It is
 * interpolated by a polynomial of sqrt(1 - b) through the exact values at the Chebyshev points of [0, 1]: near b = 1,
 * where frames without illumination have no noise, K is no polynomial of b. Where all frames have equal noise, K is
 * NormalKurtosis(). */
class SensorNoise_EXPORT MixtureKurtosis
{
public:
  explicit MixtureKurtosis(const NoiseResiduals & residuals);

  /** Returns K for a pixel. \a signalDn is its signal above black [DN], \a weight the inverse of the typical variance
   * of its residuals [1/DN^2]. */
  double
  At(double signalDn, double weight) const
  {
    return m_IsEqual ? m_Equal : this->AtFraction(this->ShotFraction(signalDn, weight));
  }
  /** Returns K for a fraction of shot noise [1]. */
  double
  AtFraction(double shotFraction) const;

private:
  /** Returns the fraction of shot noise in the variance at the mean illumination. The variance of the residuals is
   * larger by N_0 / n times the shot noise. */
  double
  ShotFraction(double signalDn, double weight) const;

  /** Number of points of the polynomial: enough for K to 2e-4 where four frames of twenty are illuminated. */
  static constexpr std::size_t Points = 9;

  bool                       m_IsEqual{ true };
  double                     m_Equal;
  std::array<double, Points> m_Polynomial{}; // coefficients in powers of 2 sqrt(1 - b) - 1
  double                     m_Gain{ 0.0 };
  double                     m_OffsetDn{ 0.0 };
  double                     m_Mean{ 0.0 }; // N_0 / n
};

/** Returns the sums of tile \a i; \a normal gives the expected K of normal noise, \a quantisationDn2 is the variance of
 * the quantization [DN^2]: only pixels whose noise exceeds the quantization step count in the tail. */
SensorNoise_EXPORT KurtosisSums
KurtosisOfTile(const NoiseResiduals & residuals, std::size_t i, const MixtureKurtosis & normal, double quantisationDn2);

/** Returns the excess kurtosis of the differences between successive frames, for normal noise with the correlation
 * matrix
 * \a frames. Each series of differences is scaled by itself, as in KurtosisSums. */
SensorNoise_EXPORT MeasuredNumber
KurtosisOfFrameDifferences(const NoiseResiduals &  residuals,
                           const Eigen::MatrixXd & frames,
                           const ParallelFor &     parallelFor);

/** Returns the kurtosis of the differences between successive frames, divided by the kurtosis of the values, that a
 * recursive filter makes of noise that is not normal [1]. The filter is y_t = a x_t + b y_(t-1), so that neighbouring
 * frames have the \a coefficient b. A filter with the weights h multiplies the kurtosis by sum h^4 / (sum h^2)^2.
 * Estimator.md, 3.12. */
SensorNoise_EXPORT double
KurtosisRatioOfRecursion(double coefficient);

/** \struct BlockPhases
 * \brief Noise covariance of nearest neighbours by their position in a block of 8 pixels.
 *
 * In frames that were compressed in blocks (ITU T.81), two neighbours in the same block have the rounding of that
 * block in common, and two neighbours in different blocks do not. Blocks of 4 and of 16 pixels are detected, too. */
struct SensorNoise_EXPORT BlockPhases
{
  static constexpr std::size_t Period = 8;

  /** Sums over pairs at each phase: first the 8 phases of the frame's columns, then the 8 phases of its rows. */
  std::array<double, 2 * Period> covariance{}; ///< sums of the relative covariance y / V, as in PairSums [1]
  std::array<double, 2 * Period> pairs{};      ///< number of pairs

  BlockPhases &
  operator+=(const BlockPhases & other);
};

/** Returns the sums of every tile. */
SensorNoise_EXPORT std::vector<BlockPhases>
SumBlockPhases(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Returns the root mean square deviation of the phases' coefficients from the mean of their axis, without the part
 * that statistical scatter explains [1]. */
SensorNoise_EXPORT double
RmsOfPhases(const std::vector<BlockPhases> & tiles);

/** Oscillation of a noise correlation coefficient with the position in the frame. Frames with fewer samples than pixels
 * have it; after a filter the correlation is the same at every position (Popescu and Farid 2005). */
struct EnlargementTrace
{
  int    lag{ 0 };               ///< distance of the neighbours [pixels]
  bool   isAlongX{ false };      ///< whether the neighbours lie, and their coefficient oscillates, along x
  bool   isAlternating{ false }; ///< whether the sign alternates from line to line
  double cyclesPerPixel{ 0.0 };
  double amplitude{ 0.0 }; ///< amplitude of the coefficient [1]
};

/** Returns the largest oscillation, if it is significant and exceeds InCorrelation.leastOscillation, which only frames
 * with fewer samples than pixels do. */
SensorNoise_EXPORT std::optional<EnlargementTrace>
FindEnlargementTrace(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Pixels of the sample that are computed from their neighbours: they are no measurements. */
struct SensorNoise_EXPORT InterpolatedPixels
{
  std::vector<std::size_t> pixels; ///< indices in the frame, in the order of the sample
  /** Pixels on the borders of the tiles, which cannot be compared with all neighbours; empty without \a pixels. */
  std::vector<std::size_t> notCompared;
  double                   fraction{ 0.0 }; ///< fraction of the pixels of the sample that they are [1]
  /** Variance that the pixels of the sample lack together, relative to their variance [1]. */
  double lostVariance{ 0.0 };

  /** Sets \a take to 0 at the pixels and at the pixels that are not compared. */
  void
  LeaveOutOf(std::vector<std::uint8_t> & take) const;
};

/** Returns the pixels of \a residuals whose noise is a copy or a mean of the noise of neighbours.
 *
 * Cameras replace defective pixels in this way, and pixels of the autofocus. The noise of such a pixel differs from the
 * mean of its neighbours by rounding alone; a measured pixel differs from it by more than its own noise. Filters reduce
 * this difference, too, but in all pixels. Returns none if more than InCorrelation.mostInterpolated of the pixels are
 * computed: the frames are then enlarged or demosaiced. Estimator.md, 3.5. */
SensorNoise_EXPORT InterpolatedPixels
FindInterpolatedPixels(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
