// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_UnequalIllumination_h
#define sensornoise_pixels_UnequalIllumination_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

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
