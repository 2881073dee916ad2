// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceLine_h
#define sensornoise_pixels_VarianceLine_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Variance of every pixel, computed where it is read: a map, corrected by a gain, and divided by ratios [DN^2]. */
struct PixelVariance
{
  const double * map{ nullptr };     ///< variance with the gain 0 [DN^2]; null: it is in `single`
  const float *  perGain{ nullptr }; ///< rise of the variance with the gain [DN]; null: 0
  const float *  ratios{ nullptr };  ///< variance relative to a uniform sensor [1]; null: 1
  double         gain{ 0.0 };        ///< gain that corrects the variance [DN/e-]
  const float *  single{ nullptr };  ///< the map in single precision

  double
  operator[](std::size_t p) const
  {
    const double own = map != nullptr ? map[p] : static_cast<double>(single[p]);
    const double corrected = perGain != nullptr ? own + gain * static_cast<double>(perGain[p]) : own;
    return ratios != nullptr ? corrected / static_cast<double>(ratios[p]) : corrected;
  }
  /** Sets \a variance to the values of \a pixels pixels from pixel \a first on. For loops with SIMD instructions. */
  void
  Fill(std::size_t first, std::size_t pixels, double * variance) const
  {
    const PixelVariance own = *this; // a copy that no pointer can alias
    for (std::size_t i = 0; own.map != nullptr && i < pixels; ++i)
    {
      variance[i] = own.map[first + i];
    }
    for (std::size_t i = 0; own.map == nullptr && i < pixels; ++i)
    {
      variance[i] = static_cast<double>(own.single[first + i]);
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
  const float *        neighbourMean{ nullptr }; ///< mean of the 8 neighbours [DN]
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
  double          pivotDn{ 0.0 };     ///< weighted mean of the means, where value and slope are uncorrelated [DN]
  double          spreadDn2{ 0.0 };   ///< weighted sum of the squared deviations of the means from the pivot [1/DN^2]
  double          curvature{ 0.0 };   ///< second-order coefficient of a parabola fitted instead [1]
  double          curvatureSd{ 0.0 }; ///< standard error of the curvature [1]
  double          trimmedFraction{ 0.0 };    ///< fraction of the pixels that were trimmed [1]
  double          noiseDispersionDn4{ 0.0 }; ///< dispersion of the noise variance from pixel to pixel [DN^4]
  bool            isDetermined{ false };

  /** Returns the line's value, at least lowestDn2 [DN^2]. */
  double
  At(double meanDn) const
  {
    return std::max(lowestDn2, intercept + gain * meanDn);
  }
  /** Returns the degrees of freedom of a normal sample variance with the same sampling variance as one pixel's
   * variance. Shot noise has the fourth cumulant g^3 q, at most g^2 V, so Var(s^2) / V^2 = 2 / dof + g^2 / (V T). The
   * second term matters if few electrons make a DN. */
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
};

class ProjectedVariance;

/** \class FrameDof
 * \brief Effective degrees of freedom of a pixel's variance if the noise differs from frame to frame.
 *
 * With the illumination factor 1 + gamma_t the variance of frame t is proportional to V_t = 1 + b gamma_t; b is the
 * fraction of the pixel's variance that is shot noise. After the projection P onto the complement of the constant and
 * the basis,
 *
 *     E[RSS] = V (n + B b),   Var[RSS] = 2 V^2 sum_st P_st^2 V_s V_t = 2 V^2 (n + 2 B b + E b^2),
 *
 * with n = tr P, B = sum_t P_tt gamma_t and E = sum_st P_st^2 gamma_s gamma_t, because sum_s P_st^2 = P_tt. The
 * estimate of V is (RSS - V B b) / n. The correction by the gain has no sampling error, so that
 *
 *     f(b) = 2 V^2 / Var[estimate] = n^2 / (n + 2 B b + E b^2).
 *
 * GainFeedback allows for the error of the gain itself. Estimator.md, 3.5. */
class SensorNoise_EXPORT FrameDof
{
public:
  /** Frames of equal noise. */
  FrameDof() = default;
  /** \a basis is orthonormal and orthogonal to the constant, frames x components. \a gamma has one number per frame;
   * numbers below -1 would be a negative illumination and count as -1. */
  FrameDof(const Eigen::MatrixXd & basis, const std::vector<double> & gamma);

  /** Returns f(b) / n, at most 1. \a shotFraction is b, clamped to [0, 1]. */
  double
  DofFractionAt(double shotFraction) const;

  /** Returns whether all frames may be treated alike: pixels with shot noise alone lose less than
   * InPixels.leastLossOfDof of their degrees of freedom, and the mean variance of the residuals, 1 + b B / n, is
   * within InPixels.leastFeedback of 1. */
  bool
  IsEqual() const
  {
    return m_IsEqual;
  }

private:
  double m_Dof{ 1.0 };    // n
  double m_Linear{ 0.0 }; // B
  double m_Square{ 0.0 }; // E
  bool   m_IsEqual{ true };
};

/** \class GainFeedback
 * \brief Dependence of the fitted variance line on the gain that corrects the variances.
 *
 * ProjectedVariance adds g k to the variance of a pixel, where k is the skew over its divisor [DN]. A fit of the result
 * has a gain and an intercept that rise by d and e per unit of g. d and e are gain and intercept of the weighted line
 * through k. A few bright frames, whose variation the temporal components mostly remove, make d large: with three
 * illuminated frames of 60 d is 0.3; with one it is 1, because the residual of this frame is 0. The gain that
 * reproduces itself is
 *
 *     g = (g_fit - d g_in) / (1 - d),   intercept = intercept_fit + e (g - g_in),
 *
 * and its error is the error of the fit over 1 - d. Estimator.md, 3.5. */
class SensorNoise_EXPORT GainFeedback
{
public:
  /** No dependence: d = e = 0. */
  GainFeedback() = default;
  /** \a ofGain is d [1], \a ofInterceptDn is e [DN]. */
  GainFeedback(double ofGain, double ofInterceptDn)
    : m_OfGain(ofGain)
    , m_OfIntercept(ofInterceptDn)
  {}
  /** Computes d and e from the pixels of \a mask, with the weights of \a line. */
  GainFeedback(const ProjectedVariance &         projected,
               const VarianceLine &              line,
               const std::vector<std::uint8_t> & mask,
               const ParallelFor &               parallelFor);

  /** Returns d [1]. */
  double
  GetOfGain() const
  {
    return m_OfGain;
  }
  /** Returns whether the absolute value of d is above InPixels.leastFeedback. */
  bool
  IsLarge() const;
  /** Returns the line that reproduces itself, with its covariance. \a fitted was fitted to variances that were computed
   * with \a gainPutIn [DN/e-]. If d is not large, the result is \a fitted. If d is above InPixels.largestFeedback, the
   * gain cannot be determined: it stays, and its standard error becomes larger than any gain that these levels
   * allow. */
  VarianceLine
  SolveFixedPoint(const VarianceLine & fitted, double gainPutIn) const;

private:
  double m_OfGain{ 0.0 };
  double m_OfIntercept{ 0.0 };
};

} // namespace sensornoise

#endif
