// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/FrameFreedom.h"

#include "sensornoise/pixels/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

FrameFreedom::FrameFreedom(const Eigen::MatrixXd & basis, const std::vector<double> & gamma)
{
  const Eigen::Index    frames = basis.rows();
  const Eigen::VectorXd factor = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames).cwiseMax(-1.0);
  Eigen::MatrixXd       projection = -basis * basis.transpose();
  projection.array() -= 1.0 / static_cast<double>(frames);
  projection.diagonal().array() += 1.0;
  m_Freedom = static_cast<double>(frames - 1 - basis.cols());
  m_Linear = projection.diagonal().dot(factor);
  m_Square = factor.dot(projection.cwiseAbs2() * factor);
  // One lit frame of many has no residual: the others are equal, but their mean is not that of all.
  m_IsEqual = !(m_Freedom > 0.0) || (this->FractionAt(1.0) > 1.0 - InPixels.leastLossOfFreedom &&
                                     std::abs(m_Linear) < InPixels.leastFeedback * m_Freedom);
}

double
FrameFreedom::FractionAt(double shotFraction) const
{
  const double b = std::min(1.0, std::max(0.0, shotFraction)); // 0 of what is no number, too
  const double mean = m_Freedom + m_Linear * b;
  const double square = m_Freedom + (2.0 * m_Linear + m_Square * b) * b;
  // Without residuals of lit frames and without read noise nothing is left, in equal frames.
  return mean > 1e-6 * m_Freedom ? std::min(1.0, mean * mean / (square * m_Freedom)) : 1.0;
}

} // namespace sensornoise
