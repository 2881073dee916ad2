// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/UnequalIllumination.h"

#include "base/Eigen.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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

GainFeedback::GainFeedback(const ProjectedVariance &         projected,
                           const VarianceLine &              line,
                           const std::vector<std::uint8_t> & mask,
                           const ParallelFor &               parallelFor)
{
  // Sums of the weight times powers of x, the mean above the pivot, and times k.
  enum : std::size_t
  {
    W,
    WX,
    WXX,
    WK,
    WXK,
    Sums
  };
  const ReferenceFrame & frame = projected.GetFrame();
  const float * const    perGain = projected.GetSquares().GetPerGain().data();
  const float * const    dof = projected.GetDof().data();
  const auto   s = SumBlocks<Sums>(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (mask[p] != 0)
      {
        const double expected = line.At(frame.neighbourMean[p]);
        const double half = 0.5 * static_cast<double>(dof[p]);
        const double w = half / (expected * expected + half * line.noiseDispersionDn4);
        const double x = frame.mean[p] - line.pivotDn;
        const auto   k = static_cast<double>(perGain[p]);
        sums[W] += w;
        sums[WX] += w * x;
        sums[WXX] += w * x * x;
        sums[WK] += w * k;
        sums[WXK] += w * x * k;
      }
    }
  });
  const double determinant = s[W] * s[WXX] - s[WX] * s[WX];
  if (determinant > InPixels.leastDeterminant * s[W] * s[WXX])
  {
    m_OfGain = (s[W] * s[WXK] - s[WX] * s[WK]) / determinant;
    m_OfIntercept = (s[WK] - m_OfGain * (s[WX] + line.pivotDn * s[W])) / s[W];
  }
}

bool
GainFeedback::IsLarge() const
{
  return std::abs(m_OfGain) > InPixels.leastFeedback;
}

VarianceLine
GainFeedback::SolveFixedPoint(const VarianceLine & fitted, double gainPutIn) const
{
  VarianceLine settled = fitted;
  if (!this->IsLarge() || !fitted.isDetermined)
  {
    return settled;
  }
  if (m_OfGain > InPixels.largestFeedback)
  {
    // As large as a slope that explains all of the variance by the dispersion of the levels, whatever slope was fitted.
    const double          error = fitted.At(fitted.pivotDn) * std::sqrt(fitted.weightSum / fitted.spreadDn2);
    const Eigen::Vector2d direction(1.0, -fitted.pivotDn);
    settled.covariance += error * error * direction * direction.transpose();
    return settled;
  }
  settled.gain = (fitted.gain - m_OfGain * gainPutIn) / (1.0 - m_OfGain);
  settled.intercept += m_OfIntercept * (settled.gain - gainPutIn);
  Eigen::Matrix2d factor;
  factor << 1.0 / (1.0 - m_OfGain), 0.0, m_OfIntercept / (1.0 - m_OfGain), 1.0;
  settled.covariance = factor * fitted.covariance * factor.transpose();
  return settled;
}

} // namespace sensornoise
