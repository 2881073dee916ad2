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
 * White noise of the covariance V I + g q Gamma, Gamma = diag(gamma_t), has after the projection P
 *
 *     E[sum_t r_t r_(t+d)] = V sum_t P_(t,t+d) + g q N_d,   N_d = sum_t (P Gamma P)_(t,t+d).
 *
 * The second term is no correlation between frames. Without gamma all frames have equal noise. Estimator.md, 3.12. */
class SensorNoise_EXPORT UnequalFrames
{
public:
  UnequalFrames() = default;
  /** \a gamma is the relative change of the illumination in each frame [1]; values below -1 count as -1. \a gain is the
   * slope of the variance [DN/e-]. \a offsetDn is the dark offset at which gamma was estimated, above the level from
   * which the signal is measured [DN]. */
  UnequalFrames(const std::vector<double> & gamma, double gain, double offsetDn);

  /** Returns whether all frames have equal noise. */
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
  /** Returns the slope of the variance [DN/e-]. */
  double
  GetGain() const
  {
    return m_Gain;
  }
  /** Returns the dark offset above the level from which the signal is measured [DN]. */
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

  /** Returns N_d for d = 0 ... lags, for the projection on the complement of an orthonormal \a basis, frames x series;
   * 0 where frames have equal noise. */
  Eigen::VectorXd
  Autocovariance(const Eigen::MatrixXd & basis, std::size_t lags) const;

private:
  Eigen::VectorXd m_Gamma;
  double          m_Gain{ 0.0 };
  double          m_OffsetDn{ 0.0 };
};

} // namespace sensornoise

#endif
