// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FrameDof.h"

#include "pixels/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

FrameDof::FrameDof(const Eigen::MatrixXd & basis, const std::vector<double> & gamma)
{
  const Eigen::Index    frames = basis.rows();
  const Eigen::VectorXd factor = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames).cwiseMax(-1.0);
  // P = 1 - Q Q', Q with the constant: sum_st P_st^2 gamma_s gamma_t = sum_t (1 - 2 h_t) gamma_t^2 + |Q' Gamma Q|^2.
  Eigen::MatrixXd q(frames, basis.cols() + 1);
  q << Eigen::VectorXd::Constant(frames, 1.0 / std::sqrt(static_cast<double>(frames))), basis;
  const Eigen::VectorXd leverage = q.cwiseAbs2().rowwise().sum();
  m_Dof = static_cast<double>(frames - q.cols());
  m_Linear = factor.dot(Eigen::VectorXd(1.0 - leverage.array()));
  m_Square = factor.cwiseAbs2().dot(Eigen::VectorXd(1.0 - 2.0 * leverage.array())) +
             (q.transpose() * factor.asDiagonal() * q).squaredNorm();
  // A single illuminated frame has no residual. The other frames are equal, but their mean is not the mean of all
  // frames.
  m_IsEqual = !(m_Dof > 0.0) || (this->DofFractionAt(1.0) > 1.0 - InPixels.leastLossOfDof &&
                                 std::abs(m_Linear) < InPixels.leastFeedback * m_Dof);
}

double
FrameDof::DofFractionAt(double shotFraction) const
{
  const double b = std::min(1.0, std::max(0.0, shotFraction)); // also makes NaN 0
  // Illuminated frames without residuals, and no read noise, leave no noise; then the frames count as equal.
  const double square = m_Dof + (2.0 * m_Linear + m_Square * b) * b;
  return square > m_Dof ? m_Dof / square : 1.0;
}

} // namespace sensornoise
