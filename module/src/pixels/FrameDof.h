// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FrameDof_h
#define sensornoise_pixels_FrameDof_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

#include <vector>

namespace sensornoise
{

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

} // namespace sensornoise

#endif
