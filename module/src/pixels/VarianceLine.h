// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceLine_h
#define sensornoise_pixels_VarianceLine_h

#include "base/Eigen.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Maps of a regression of the variance on the mean. */
struct VarianceData
{
  const double *       mean;          ///< [DN]
  const double *       neighbourMean; ///< mean of the 8 neighbours [DN]
  const double *       variance;      ///< unbiased [DN^2]
  const float *        freedom;       ///< degrees of freedom of the variance
  const std::uint8_t * mask;          ///< nonzero at the pixels that count
  std::size_t          pixels;
};

/** variance = intercept + gain mean, and how sure. */
struct VarianceLine
{
  double          gain{ 0.0 };                           ///< [DN/e-]
  double          intercept{ 0.0 };                      ///< [DN^2]
  double          lowestDn2{ 0.0 };                      ///< the line is cut there where it serves as a variance [DN^2]
  Eigen::Matrix2d covariance{ Eigen::Matrix2d::Zero() }; ///< of (gain, intercept), sandwich
  double          weightSum{ 0.0 };                      ///< of the weights
  double          pivotDn{ 0.0 };       ///< weighted mean of the means: slope and value there are uncorrelated
  double          spreadDn2{ 0.0 };     ///< weighted sum of their squared deviations
  double          curvature{ 0.0 };     ///< of the parabola in its place [1]
  double          curvatureTilt{ 0.0 }; ///< of the parabola's departure, see BendAt()
  double          curvatureLift{ 0.0 };
  double          curvatureSd{ 0.0 };     ///< standard error of the curvature
  double          trimmedFraction{ 0.0 }; ///< of the pixels
  double          noiseSpreadDn4{ 0.0 };  ///< variance from pixel to pixel of their own noise's variance
  bool            isDetermined{ false };

  /** The line's value, or lowestDn2 where it is below that [DN^2]. */
  double
  At(double meanDn) const
  {
    return std::max(lowestDn2, intercept + gain * meanDn);
  }
  /** The degrees of freedom of the normal sample variance that scatters as much as that of one pixel. Shot noise has
   * the fourth cumulant g^3 q, at most g^2 V, so that Var(s^2) / V^2 = 2 / freedom + g^2 / (V T) where few electrons
   * make a DN. */
  double
  SamplingFreedom(double freedom, double varianceDn2) const
  {
    return freedom * varianceDn2 / (varianceDn2 + 0.5 * gain * gain);
  }
  /** The variance of that sample variance [DN^4]. */
  double
  SamplingVariance(double freedom, double varianceDn2) const
  {
    return 2.0 * varianceDn2 * (varianceDn2 + 0.5 * gain * gain) / freedom;
  }
  /** The same degrees from pixel to pixel, whose own noise differs. */
  double
  EffectiveFreedom(double freedom, double varianceDn2) const
  {
    const double square = varianceDn2 * varianceDn2;
    return freedom * square / (square + 0.5 * (gain * gain * varianceDn2 + freedom * noiseSpreadDn4));
  }
  /** How far the parabola in the line's place departs from it [DN^2]. */
  double
  BendAt(double meanDn) const
  {
    const double x = meanDn - pivotDn;
    return curvature * (x * x - curvatureTilt * x - curvatureLift);
  }
};

} // namespace sensornoise

#endif
