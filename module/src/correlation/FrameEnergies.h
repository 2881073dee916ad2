// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_FrameEnergies_h
#define sensornoise_correlation_FrameEnergies_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseResiduals.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class FrameEnergies
 * \brief Mean squared residuals of every frame in each tile of the noise sample, and their expectation by a noise
 * model.
 *
 * With P = I - Q Q' the residuals r = P u of a pixel whose noise has the variance V_s in frame s have
 *
 *     E[r_t^2] = sum_s M_ts V_s,   M = diag(1 - 2 h) + (Q Q') o (Q Q'),
 *
 * where h is the diagonal of Q Q' and o the product of the elements. Rows of M add up to 1 - h. Estimator.md, 3.14. */
class SensorNoise_EXPORT FrameEnergies
{
public:
  /** Makes an object without tiles. */
  FrameEnergies() = default;
  /** Sums over the pixels that have a weight in \a residuals and whose \a take is not 0. A tile without these pixels is
   * left out. */
  FrameEnergies(const NoiseResiduals &            residuals,
                const std::vector<std::uint8_t> & take,
                const ParallelFor &               parallelFor);
  /** Takes given numbers. \a squaresDn2 is tiles x frames [DN^2]; \a signalDn [DN] and \a pixels have a value for each
   * tile. \a basis is the orthonormal Q, frames x series, which includes the constant. */
  FrameEnergies(Eigen::MatrixXd squaresDn2, Eigen::VectorXd signalDn, Eigen::VectorXd pixels, Eigen::MatrixXd basis);

  Eigen::Index
  Tiles() const
  {
    return m_SquaresDn2.rows();
  }
  Eigen::Index
  Frames() const
  {
    return m_SquaresDn2.cols();
  }
  /** Returns the mean squared residuals, tiles x frames [DN^2]. */
  const Eigen::MatrixXd &
  SquaresDn2() const
  {
    return m_SquaresDn2;
  }
  /** Returns the mean signal of each tile's pixels, above the black level of the residuals [DN]. */
  const Eigen::VectorXd &
  SignalDn() const
  {
    return m_SignalDn;
  }
  /** Returns the number of pixels in each tile. */
  const Eigen::VectorXd &
  Pixels() const
  {
    return m_Pixels;
  }
  /** Returns M times \a variances, the expected squared residuals; \a variances has a value for each frame [DN^2]. */
  Eigen::VectorXd
  ExpectedSquares(const Eigen::VectorXd & variances) const;
  /** Returns the fraction 1 - h_t of the noise variance that remains in the residuals of each frame, for noise that is
   * the same in all frames [1]. */
  const Eigen::VectorXd &
  RemainingFraction() const
  {
    return m_RemainingFraction;
  }

  /** Divides the squared residuals of each frame in all tiles by its factor [1]. */
  void
  DivideBy(const Eigen::VectorXd & factors);

private:
  void
  FillRemainingFraction();

  Eigen::MatrixXd m_SquaresDn2;
  Eigen::VectorXd m_SignalDn;
  Eigen::VectorXd m_Pixels;
  Eigen::MatrixXd m_Basis;
  Eigen::VectorXd m_RemainingFraction;
};

} // namespace sensornoise

#endif
