// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_AutocovarianceFit_h
#define sensornoise_correlation_AutocovarianceFit_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

#include <cstddef>

namespace sensornoise
{

/** Returns the matrix M by which the projection mixes the autocovariances R_k of a series. With P = I - Q Q', for
 * orthonormal \a basis Q,
 *
 *     E[sum_t r_t r_(t+d)] = sum_k M_dk R_k,   M_dk = sum_t (P B_k P)_(t, t+d),   d = 0 ... lags, k = 0 ... furthest,
 *
 * where B_0 = I and B_k is the shift by k frames both ways. Exact for any distribution of the noise. */
SensorNoise_EXPORT Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags, std::size_t furthest);

/** \class AutocovarianceFit
 * \brief Autocovariances of the noise, from the sums of products of frames after the projection.
 *
 * The autocovariances R_0 ... R_K are free, and solve the system of TemporalMixing(). Those of larger lags are 0, or
 * they decrease by a constant ratio, as behind a recursive filter (FindTail()). Without them the sum over all lags of
 * a short burst is too small: the projection removes slow noise. Estimator.md, 3.12.
 *
 * The arguments \a sums of the functions are sum_t r_t r_(t+d), d = 0 ... K, in any unit. Their results are linear in
 * the sums, and have the same unit. */
class SensorNoise_EXPORT AutocovarianceFit
{
public:
  /** \param basis orthonormal temporal components that were projected out
   * \param lags number K of lags */
  AutocovarianceFit(const Eigen::MatrixXd & basis, std::size_t lags);

  /** Finds the tail: white noise and R_k = A q^k, with the ratio q for which both describe \a sums best. The tail
   * stays 0 if these two terms leave more than InCorrelation.largestTailMisfit of what white noise alone leaves, as
   * after means over several frames. */
  void
  FindTail(const Eigen::VectorXd & sums);
  bool
  HasTail() const
  {
    return m_Ratio > 0.0;
  }
  /** Returns R_0 ... R_K. */
  Eigen::VectorXd
  Autocovariances(const Eigen::VectorXd & sums) const
  {
    return m_Autocovariances * sums;
  }
  /** Returns R_0 + 2 (R_1 + R_2 + ...), with the tail. */
  double
  Total(const Eigen::VectorXd & sums) const
  {
    return m_Total * sums;
  }

private:
  void
  Solve();

  Eigen::MatrixXd    m_Basis;
  Eigen::MatrixXd    m_Mixing; // columns from lag 0 on
  double             m_Ratio{ 0.0 };
  Eigen::MatrixXd    m_Autocovariances; // what the sums are multiplied by
  Eigen::RowVectorXd m_Total;
};

} // namespace sensornoise

#endif
