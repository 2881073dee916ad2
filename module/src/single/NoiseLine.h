// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_NoiseLine_h
#define sensornoise_single_NoiseLine_h

#include "SensorNoiseExport.h"
#include "single/ClippedNormal.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Pixels of about one level, away from edges. */
struct LevelSet
{
  double levelDn{ 0.0 };     ///< mean, after clipping
  double varianceDn2{ 0.0 }; ///< of a pixel, after clipping
  double details{ 0.0 };     ///< independent detail coefficients that the variance is made of
};

/** The line through the variance of level sets. */
struct NoiseLine
{
  CentredLine         line;
  double              slopeVariance{ 0.0 };   ///< squared standard error of the slope [DN^2]
  double              centreVariance{ 0.0 };  ///< of the variance at the centre [DN^4]
  double              slopeCovariance{ 0.0 }; ///< of both [DN^3]
  double              reducedChi2{ 0.0 };     ///< of the level sets about the line [1]
  double              details{ 0.0 };         ///< coefficients of the level sets that were fitted
  std::vector<double> expectedDn2;            ///< variance that the line gives every level set, after clipping
  std::vector<bool>   isFitted;               ///< which level sets were
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
 * ClippedAtMean() gives and a relative variance of InSingle.truncatedVariance / n. Level sets that are mostly clipped,
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
