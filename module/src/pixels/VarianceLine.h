// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceLine_h
#define sensornoise_pixels_VarianceLine_h

#include "base/Eigen.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Variance of every pixel, computed where it is read: a map, corrected by a gain, and divided by ratios [DN^2]. */
struct PixelVariance
{
  const double * map{ nullptr };     ///< variance with the gain 0 [DN^2]
  const float *  perGain{ nullptr }; ///< rise of the variance with the gain [DN]; null: 0
  const float *  ratios{ nullptr };  ///< variance relative to a uniform sensor [1]; null: 1
  double         gain{ 0.0 };        ///< gain that corrects the variance [DN/e-]

  double
  operator[](std::size_t p) const
  {
    const double corrected = perGain != nullptr ? map[p] + gain * static_cast<double>(perGain[p]) : map[p];
    return ratios != nullptr ? corrected / static_cast<double>(ratios[p]) : corrected;
  }
  /** Sets \a variance to the values of \a pixels pixels from pixel \a first on. For loops with SIMD instructions. */
  void
  Fill(std::size_t first, std::size_t pixels, double * variance) const
  {
    const PixelVariance own = *this; // a copy that no pointer can alias
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] = own.map[first + i];
    }
    for (std::size_t i = 0; own.perGain != nullptr && i < pixels; ++i)
    {
      variance[i] += own.gain * static_cast<double>(own.perGain[first + i]);
    }
    for (std::size_t i = 0; own.ratios != nullptr && i < pixels; ++i)
    {
      variance[i] /= static_cast<double>(own.ratios[first + i]);
    }
  }
};

/** Maps for a regression of the variance on the mean. */
struct VarianceData
{
  const double *       mean{ nullptr };          ///< temporal mean [DN]
  const double *       neighbourMean{ nullptr }; ///< mean of the 8 neighbours [DN]
  PixelVariance        variance;                 ///< unbiased variance [DN^2]
  const float *        dof{ nullptr };           ///< degrees of freedom of the variance
  const std::uint8_t * mask{ nullptr };          ///< nonzero at the pixels that count
  std::size_t          pixels{ 0 };              ///< number of pixels

  /** Returns the means of the neighbours of pixels of the mask, see SamplePixels() [DN]. */
  std::vector<double>
  SampleLevels() const
  {
    std::vector<double> levels;
    for (const std::size_t p : SamplePixels(mask, pixels))
    {
      levels.push_back(neighbourMean[p]);
    }
    return levels;
  }
};

/** Line variance = intercept + gain mean, with its errors. */
struct VarianceLine
{
  double          gain{ 0.0 };                           ///< system gain [DN/e-]
  double          intercept{ 0.0 };                      ///< variance at mean 0 [DN^2]
  double          lowestDn2{ 0.0 };                      ///< lower limit of At() [DN^2]
  Eigen::Matrix2d covariance{ Eigen::Matrix2d::Zero() }; ///< covariance of (gain, intercept), sandwich estimate
  double          weightSum{ 0.0 };                      ///< sum of the weights [1/DN^4]
  double          pivotDn{ 0.0 };       ///< weighted mean of the means, where value and slope are uncorrelated [DN]
  double          spreadDn2{ 0.0 };     ///< weighted sum of the squared deviations of the means from the pivot [1/DN^2]
  double          curvature{ 0.0 };     ///< second-order coefficient of a parabola fitted instead [1]
  double          curvatureTilt{ 0.0 }; ///< linear term of the parabola's deviation, see CurvatureDeviationAt() [DN]
  double curvatureLift{ 0.0 };      ///< constant term of the parabola's deviation, see CurvatureDeviationAt() [DN^2]
  double curvatureSd{ 0.0 };        ///< standard error of the curvature [1]
  double trimmedFraction{ 0.0 };    ///< fraction of the pixels that were trimmed [1]
  double noiseDispersionDn4{ 0.0 }; ///< dispersion of the noise variance from pixel to pixel [DN^4]
  bool   isDetermined{ false };

  /** Returns the line's value, at least lowestDn2 [DN^2]. */
  double
  At(double meanDn) const
  {
    return std::max(lowestDn2, intercept + gain * meanDn);
  }
  /** Returns the degrees of freedom of a normal sample variance with the same sampling variance as one pixel's
   * variance. Shot noise has the fourth cumulant g^3 q, at most g^2 V, so Var(s^2) / V^2 = 2 / freedom + g^2 / (V T).
   * The second term matters if few electrons make a DN. */
  double
  SamplingDof(double dof, double varianceDn2) const
  {
    return dof * varianceDn2 / (varianceDn2 + 0.5 * gain * gain);
  }
  /** Returns the sampling variance of a pixel's variance [DN^4]. */
  double
  SamplingVariance(double dof, double varianceDn2) const
  {
    return 2.0 * varianceDn2 * (varianceDn2 + 0.5 * gain * gain) / dof;
  }
  /** Returns SamplingDof() reduced by the dispersion of the noise variance from pixel to pixel. */
  double
  EffectiveDof(double dof, double varianceDn2) const
  {
    const double square = varianceDn2 * varianceDn2;
    return dof * square / (square + 0.5 * (gain * gain * varianceDn2 + dof * noiseDispersionDn4));
  }
  /** Returns the deviation of the fitted parabola from the line [DN^2]. */
  double
  CurvatureDeviationAt(double meanDn) const
  {
    const double x = meanDn - pivotDn;
    return curvature * (x * x - curvatureTilt * x - curvatureLift);
  }
};

} // namespace sensornoise

#endif
