// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FrameFreedom_h
#define sensornoise_pixels_FrameFreedom_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

#include <vector>

namespace sensornoise
{

/** \class FrameFreedom
 * \brief Effective degrees of freedom of a pixel's variance where the noise differs from frame to frame.
 *
 * With the illumination factor 1 + gamma_t the variance of a frame is in proportion to V_t = 1 + b gamma_t, b the
 * fraction of the pixel's variance that is shot noise. After the projection P onto the complement of the constant and
 * the basis,
 *
 *     E[RSS] = V (n + B b),   Var[RSS] = 2 V^2 sum_st P_st^2 V_s V_t = 2 V^2 (n + 2 B b + E b^2),
 *
 * n = tr P, B = sum_t P_tt gamma_t, E = sum_st P_st^2 gamma_s gamma_t, as sum_s P_st^2 = P_tt. The estimate of V is
 * (RSS - V B b) / n: the correction by the gain does not scatter, and
 *
 *     f(b) = 2 V^2 / Var[estimate] = n^2 / (n + 2 B b + E b^2).
 *
 * That the gain itself is estimated is for GainFeedback. Estimator.md, 3.5. */
class SensorNoise_EXPORT FrameFreedom
{
public:
  /** Frames of equal noise. */
  FrameFreedom() = default;
  /** \a basis: orthonormal and orthogonal to the constant, frames x series. \a gamma: one number a frame; below -1,
   * where there would be no illumination, it counts as -1. */
  FrameFreedom(const Eigen::MatrixXd & basis, const std::vector<double> & gamma);

  /** f(b) / n, at most 1. \a shotFraction is b; outside of [0, 1] it counts as the nearer of both. */
  double
  FractionAt(double shotFraction) const;

  /** Whether all frames may count alike: pixels of shot noise alone lose less than InPixels.leastLossOfFreedom of their
   * degrees of freedom, and the mean variance of the residuals, 1 + b B / n, is within InPixels.leastFeedback of 1. */
  bool
  IsEqual() const
  {
    return m_IsEqual;
  }

private:
  double m_Freedom{ 1.0 }; // n
  double m_Linear{ 0.0 };  // B
  double m_Square{ 0.0 };  // E
  bool   m_IsEqual{ true };
};

} // namespace sensornoise

#endif
