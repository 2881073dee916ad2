// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_UnequalFrames_h
#define sensornoise_correlation_UnequalFrames_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class UnequalFrames
 * \brief Noise that is stronger in bright frames: V_t = V + g gamma_t q for a pixel of signal q.
 *
 * White noise of the covariance V I + g q Gamma, Gamma = diag(gamma_t), is left by the projection P with
 *
 *     E[sum_t r_t r_(t+d)] = V sum_t P_(t,t+d) + g q N_d,   N_d = sum_t (P Gamma P)_(t,t+d).
 *
 * The second term is no correlation between frames. Without a gamma all frames are alike. Estimator.md, 3.12. */
class SensorNoise_EXPORT UnequalFrames
{
public:
  UnequalFrames() = default;
  /** \a gamma: of each frame [1]; below -1 it counts as -1. \a gain: slope of the variance [DN/e-]. \a offsetDn: dark
   * offset to which gamma belongs, above the level from which light is measured [DN]. */
  UnequalFrames(const std::vector<double> & gamma, double gain, double offsetDn);

  bool
  AreEqual() const
  {
    return m_Gamma.size() == 0;
  }
  const Eigen::VectorXd &
  GetGamma() const
  {
    return m_Gamma;
  }
  double
  GetGain() const
  {
    return m_Gain;
  }
  double
  GetOffsetDn() const
  {
    return m_OffsetDn;
  }
  /** Leaves out all but the last frames. */
  void
  KeepLast(Eigen::Index frames);
  /** Leaves out all but the first frames. */
  void
  KeepFirst(Eigen::Index frames);

  /** N_d of d = 0 ... lags for the complement of an orthonormal \a basis, frames x series; 0 where frames are alike. */
  Eigen::VectorXd
  Autocovariance(const Eigen::MatrixXd & basis, std::size_t lags) const;

private:
  Eigen::VectorXd m_Gamma;
  double          m_Gain{ 0.0 };
  double          m_OffsetDn{ 0.0 };
};

} // namespace sensornoise

#endif
