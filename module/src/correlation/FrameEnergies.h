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
 * \brief The mean square of the residuals of every frame, tile by tile of the noise sample, and what a noise model
 * makes of it.
 *
 * With P = I - Q Q' the residuals r = P u of a pixel whose noise has the variance V_s in frame s have
 *
 *     E[r_t^2] = sum_s M_ts V_s,   M = diag(1 - 2 h) + (Q Q') o (Q Q'),
 *
 * where h is the diagonal of Q Q' and o the product of the elements. Rows of M add up to 1 - h. Estimator.md, 3.14. */
class SensorNoise_EXPORT FrameEnergies
{
public:
  /** No tiles. */
  FrameEnergies() = default;
  /** Sums over the pixels that \a residuals take and for which \a take is not 0; a tile without one is left out. */
  FrameEnergies(const NoiseResiduals &            residuals,
                const std::vector<std::uint8_t> & take,
                const ParallelFor &               parallelFor);
  /** Takes given numbers: \a squaresDn2 is tiles x frames, \a lightDn and \a pixels of every tile, \a basis the
   * orthonormal Q, frames x series, with the constant. */
  FrameEnergies(Eigen::MatrixXd squaresDn2, Eigen::VectorXd lightDn, Eigen::VectorXd pixels, Eigen::MatrixXd basis);

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
  /** Mean squares, tiles x frames [DN^2]. */
  const Eigen::MatrixXd &
  SquaresDn2() const
  {
    return m_SquaresDn2;
  }
  /** The mean light of a tile's pixels, above the level from which \a residuals measure light [DN]. */
  const Eigen::VectorXd &
  LightDn() const
  {
    return m_LightDn;
  }
  /** How many pixels were taken. */
  const Eigen::VectorXd &
  Pixels() const
  {
    return m_Pixels;
  }
  /** M times \a variances, one for each frame [DN^2]. */
  Eigen::VectorXd
  ExpectedSquares(const Eigen::VectorXd & variances) const;
  /** The part 1 - h_t of each frame's noise that is left in its residuals, of noise that is the same in all frames [1].
   */
  const Eigen::VectorXd &
  LeftShare() const
  {
    return m_LeftShare;
  }

private:
  void
  FillLeftShare();

  Eigen::MatrixXd m_SquaresDn2;
  Eigen::VectorXd m_LightDn;
  Eigen::VectorXd m_Pixels;
  Eigen::MatrixXd m_Basis;
  Eigen::VectorXd m_LeftShare;
};

} // namespace sensornoise

#endif
