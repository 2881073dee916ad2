// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_MixtureKurtosis_h
#define sensornoise_correlation_MixtureKurtosis_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** E[sum_t r_t^4 / (sum_t r_t^2)^2] of normal numbers r of a \a covariance, exactly, as an integral over s from 0 on:
 *
 *     3 int s |1 + 2 s S|^(-1/2) sum_t m_t(s)^2 ds,   m(s) the diagonal of S (1 + 2 s S)^(-1),
 *
 * for 1/a^2 = int s exp(-s a) ds, and exp(-s r'r) makes of the numbers normal ones of a smaller covariance. */
SensorNoise_EXPORT double
KurtosisOfNormal(const Eigen::MatrixXd & covariance);

/** \class MixtureKurtosis
 * \brief The kurtosis K of KurtosisSums that normal noise has, where its variance differs from frame to frame.
 *
 * Frames of different variances are a mixture, whose tails are longer than those of one normal distribution, without
 * any step that is not linear. It depends on the fraction b of a pixel's variance that is shot noise, as a polynomial
 * of sqrt(1 - b) through the exact values at Chebyshev's points of [0, 1]: near b = 1, where frames without any light
 * have no noise, K itself is no polynomial of b. Where all frames are alike, K is NormalKurtosis(). */
class SensorNoise_EXPORT MixtureKurtosis
{
public:
  explicit MixtureKurtosis(const NoiseResiduals & residuals);

  /** K of a pixel: its light above black, and the inverse of its residuals' typical variance [1/DN^2]. */
  double
  At(double lightDn, double weight) const
  {
    return m_IsEqual ? m_Equal : this->AtFraction(this->ShotFraction(lightDn, weight));
  }
  /** K of a fraction of shot noise. */
  double
  AtFraction(double shotFraction) const;

private:
  /** Of the variance at the mean illumination; the residuals' is larger by N_0 / n of the shot noise. */
  double
  ShotFraction(double lightDn, double weight) const;

  /** Points of the polynomial: enough for K to 2e-4 where four frames of twenty are lit. */
  static constexpr std::size_t Points = 9;

  bool                       m_IsEqual{ true };
  double                     m_Equal;
  std::array<double, Points> m_Polynomial{}; // of 2 sqrt(1 - b) - 1
  double                     m_Gain{ 0.0 };
  double                     m_OffsetDn{ 0.0 };
  double                     m_Mean{ 0.0 }; // N_0 / n
};

} // namespace sensornoise

#endif
