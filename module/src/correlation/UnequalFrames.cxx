// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/UnequalFrames.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

UnequalFrames::UnequalFrames(const std::vector<double> & gamma, double gain, double offsetDn)
  : m_Gamma(Eigen::Map<const Eigen::VectorXd>(gamma.data(), static_cast<Eigen::Index>(gamma.size())).cwiseMax(-1.0))
  , m_Gain(gain)
  , m_OffsetDn(offsetDn)
{}

void
UnequalFrames::KeepLast(Eigen::Index frames)
{
  m_Gamma = Eigen::VectorXd(m_Gamma.tail(std::min(frames, m_Gamma.size())));
}

void
UnequalFrames::KeepFirst(Eigen::Index frames)
{
  m_Gamma = Eigen::VectorXd(m_Gamma.head(std::min(frames, m_Gamma.size())));
}

Eigen::VectorXd
UnequalFrames::Autocovariance(const Eigen::MatrixXd & basis, std::size_t lags) const
{
  const auto      last = static_cast<Eigen::Index>(lags);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(last + 1);
  if (this->AreEqual())
  {
    return sums;
  }
  // P Gamma P = Gamma - Q (Gamma Q)' - (Gamma Q) Q' + Q (Q' Gamma Q) Q'
  const Eigen::MatrixXd weighted = m_Gamma.asDiagonal() * basis;
  const Eigen::MatrixXd both = basis * (basis.transpose() * weighted);
  for (Eigen::Index d = 0; d <= last; ++d)
  {
    const Eigen::Index rows = basis.rows() - d;
    const auto         along = [&](const Eigen::MatrixXd & a, const Eigen::MatrixXd & b) {
      return a.topRows(rows).cwiseProduct(b.bottomRows(rows)).sum();
    };
    const double own = d == 0 ? m_Gamma.sum() : 0.0;
    sums(d) = own - along(basis, weighted) - along(weighted, basis) + along(both, basis);
  }
  return sums;
}

} // namespace sensornoise
