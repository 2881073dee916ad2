// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_limits_CramerRaoInformation_h
#define sensornoise_limits_CramerRaoInformation_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "limits/CramerRaoInput.h"

#include <cstddef>

namespace sensornoise
{

/** Fisher information of rows of a frame on the parameters that all pixels have in common, in the order g, c0, mu,
 * gamma_1..T, alpha_1..T, beta_1..T. The flux q_x of each pixel is unknown, too, and is eliminated: a pixel adds the
 * Schur complement I - c_x c_x' / I_xx of its arrow matrix. c0 is the noise variance at the mean level,
 * V = g (level - mean level) + c0. It is less correlated with g than the intercept, and does not depend on mu. */
class SensorNoise_EXPORT CramerRaoInformation
{
public:
  static constexpr Eigen::Index Gain = 0;
  static constexpr Eigen::Index CentralVariance = 1;
  static constexpr Eigen::Index Offset = 2;
  static constexpr Eigen::Index FirstSeries = 3;

  /** Prepares the information, all 0. \a meanFluxDn is the mean level minus mu [DN]. */
  CramerRaoInformation(const CramerRaoInput & input, double meanFluxDn);

  /** Adds the information of row \a y in all frames. */
  void
  AddRow(std::size_t y);

  /** Adds the information of other rows. */
  void
  Add(const CramerRaoInformation & other);

  /** Returns the standard errors that the parameters would have if each were the only unknown; 1 where there is no
   * information. */
  Eigen::VectorXd
  GetUnits() const;

  /** Returns the covariance of the parameters' errors under the constraints sum gamma = sum alpha = sum beta = 0, which
   * fix the scale and the position of the scene. A direction without information has a variance of 1e20 units. */
  Eigen::MatrixXd
  GetCovariance() const;

private:
  /** Derivatives of a row's data with respect to g, c0, mu and the frame's own gamma, alpha and beta, one row per
   * pixel. */
  using SixColumns = Eigen::Array<double, Eigen::Dynamic, 6>;
  struct Derivatives
  {
    SixColumns ofMean;
    SixColumns ofVariance;
  };

  /** Returns 1 where a pixel of row \a y is used, 0 elsewhere. */
  Eigen::ArrayXd
  GetUse(std::size_t y) const;

  Derivatives
  GetDerivatives(std::size_t y, std::size_t frame) const;

  /** Returns q(alpha, beta) of row \a y, interpolated as in StackSimulator [DN]. */
  Eigen::ArrayXd
  ShiftedFlux(std::size_t y, double alpha, double beta) const;

  CramerRaoInput  m_Input;
  double          m_FluxPerElectronDn;
  double          m_MeanFluxDn;
  Eigen::Index    m_Frames;
  Eigen::MatrixXd m_Schur;  // lower triangle
  Eigen::VectorXd m_Direct; // diagonal for known fluxes of the pixels
};

} // namespace sensornoise

#endif
