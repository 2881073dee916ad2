// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_NoiseLine_h
#define sensornoise_single_NoiseLine_h

#include "SensorNoiseExport.h"

#include <limits>
#include <vector>

namespace sensornoise
{

/** Levels between which a value is cut off [DN]; infinite: it is not. */
struct ClipLevels
{
  double lowDn{ -std::numeric_limits<double>::infinity() };
  double highDn{ std::numeric_limits<double>::infinity() };
};

/** Moments of a normal variable that is set to a clip level where it is beyond. */
struct ClippedMoments
{
  double meanDn{ 0.0 };
  double varianceDn2{ 0.0 };
  double unclipped{ 1.0 }; ///< probability of a value between the clip levels [1]
};

/** Returns the moments of a normal variable of mean \a meanDn and standard deviation \a sdDn > 0, clipped at both ends:
 * the integrals of x and x^2 over the normal density between the levels, and the probabilities of the levels. */
SensorNoise_EXPORT ClippedMoments
MomentsOfClipped(double meanDn, double sdDn, const ClipLevels & levels);

/** Variance against level before clipping: slope times (level - centre) + variance at the centre. */
struct CentredLine
{
  double centreDn{ 0.0 };
  double slopeDn{ 0.0 }; ///< [DN/e-]
  double atCentreDn2{ 0.0 };

  double
  At(double levelDn) const
  {
    return atCentreDn2 + slopeDn * (levelDn - centreDn);
  }
};

/** Returns the moments of the pixels whose mean after clipping is \a clippedMeanDn, if \a line is their variance before
 * clipping, but at least \a leastVarianceDn2 > 0. */
SensorNoise_EXPORT ClippedMoments
ClippedAtMean(double clippedMeanDn, const CentredLine & line, const ClipLevels & levels, double leastVarianceDn2);

/** Pixels of about one level, away from edges. */
struct LevelSet
{
  double levelDn{ 0.0 };     ///< mean, after clipping
  double varianceDn2{ 0.0 }; ///< variance of a pixel, after clipping
  double details{ 0.0 };     ///< number of independent detail coefficients of the variance
};

/** The line through the variance of level sets. */
struct NoiseLine
{
  CentredLine         line;
  double              slopeVariance{ 0.0 };   ///< squared standard error of the slope [DN^2]
  double              centreVariance{ 0.0 };  ///< squared standard error of the variance at the centre [DN^4]
  double              slopeCovariance{ 0.0 }; ///< covariance of the errors of slope and variance at the centre [DN^3]
  double              reducedChi2{ 0.0 };     ///< reduced chi-square of the level sets about the line [1]
  double              details{ 0.0 };         ///< coefficients of the level sets that were fitted
  std::vector<double> expectedDn2;            ///< variance that the line gives every level set, after clipping
  std::vector<bool>   isFitted;               ///< whether a level set takes part in the fit
  bool                isDetermined{ false };  ///< false: too few level sets, or all of one level

  /** Squared standard error of the variance at level 0 [DN^4]. */
  double
  InterceptVariance() const
  {
    const double c = line.centreDn;
    return centreVariance - 2.0 * c * slopeCovariance + c * c * slopeVariance;
  }
  /** Covariance of the slope with the variance at level 0 [DN^3]. */
  double
  InterceptCovariance() const
  {
    return slopeCovariance - line.centreDn * slopeVariance;
  }
  double
  InterceptDn2() const
  {
    return line.At(0.0);
  }
};

/** Fits the line by maximum likelihood: the variance of n coefficients has a gamma distribution, with the mean that
 * ClippedAtMean() gives and a relative variance of TruncatedVariance / n. Level sets that are mostly clipped,
 * or have too few coefficients, are left out. \a start is the line from which Fisher scoring begins. \a
 * leastVarianceDn2 is the smallest variance that the frames can show, by quantization. The errors hold for white
 * noise; where the level sets scatter more, they are larger by the root of the reduced chi-square. */
SensorNoise_EXPORT NoiseLine
FitNoiseLine(const std::vector<LevelSet> & sets,
             const ClipLevels &            levels,
             double                        leastVarianceDn2,
             const CentredLine &           start);

} // namespace sensornoise

#endif
