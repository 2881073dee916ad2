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

/** Information of rows of a frame about the parameters that all pixels share, in the order g, c0, mu, gamma_1..T,
 * alpha_1..T, beta_1..T. A pixel's flux q_x is unknown too and is eliminated: the pixel adds the Schur complement
 * I - c_x c_x' / I_xx of its arrow matrix. c0 is the noise variance at the mean level, V = g (level - mean level) + c0:
 * less correlated with g than the intercept is, and free of mu. */
class SensorNoise_EXPORT CramerRaoInformation
{
public:
  static constexpr Eigen::Index Gain = 0;
  static constexpr Eigen::Index CentralVariance = 1;
  static constexpr Eigen::Index Offset = 2;
  static constexpr Eigen::Index FirstSeries = 3;

  /** \a meanFluxDn is the mean level less mu. */
  CramerRaoInformation(const CramerRaoInput & input, double meanFluxDn);

  /** Adds what row \a y says, in all frames. */
  void
  AddRow(std::size_t y);

  /** Adds what other rows say. */
  void
  Add(const CramerRaoInformation & other);

  /** Standard deviations that the parameters would have if each were the only one not known; 1 where there is none. */
  Eigen::VectorXd
  GetUnits() const;

  /** Covariance of the parameters' errors where sum gamma = sum alpha = sum beta = 0, which fixes the scale and the
   * position of the scene. A direction of which the rows say nothing has a variance of 1e20 units. */
  Eigen::MatrixXd
  GetCovariance() const;

private:
  /** Derivatives of a row's data with g, c0, mu and the frame's own gamma, alpha and beta: a row a pixel. */
  using SixColumns = Eigen::Array<double, Eigen::Dynamic, 6>;
  struct Derivatives
  {
    SixColumns ofMean;
    SixColumns ofVariance;
  };

  /** 1 where a pixel of row \a y is used, 0 elsewhere. */
  Eigen::ArrayXd
  GetUse(std::size_t y) const;

  Derivatives
  GetDerivatives(std::size_t y, std::size_t frame) const;

  /** q(alpha, beta) of row \a y [DN], interpolated as StackSimulator does. */
  Eigen::ArrayXd
  ShiftedFlux(std::size_t y, double alpha, double beta) const;

  CramerRaoInput  m_Input;
  double          m_FluxPerElectronDn;
  double          m_MeanFluxDn;
  Eigen::Index    m_Frames;
  Eigen::MatrixXd m_Schur;  // lower triangle
  Eigen::VectorXd m_Direct; // diagonal, pixels' fluxes known
};

} // namespace sensornoise

#endif
