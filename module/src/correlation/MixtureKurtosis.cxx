// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/MixtureKurtosis.h"

#include "correlation/NoiseKurtosis.h"
#include "correlation/UnequalFrames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

double
KurtosisOfNormal(const Eigen::MatrixXd & covariance)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const double                                         trace = covariance.trace();
  const Eigen::ArrayXd  scales = solver.eigenvalues().array().max(0.0) / trace; // K does not depend on the scale
  const Eigen::MatrixXd squares = solver.eigenvectors().cwiseAbs2();
  // Trapezoidal rule in y = ln s, whose error decreases exponentially. The integrand s^2 (...) is s^2 near 0 and
  // decreases as s^(-n/2) for n degrees of freedom. Checked against the closed form for equal frames: 1e-9.
  constexpr double first = -12.0;
  constexpr double last = 24.0;
  constexpr double step = 0.125;
  double           sum = 0.0;
  for (double y = first; y < last; y += step)
  {
    const double          s = std::exp(y);
    const Eigen::ArrayXd  rest = 1.0 + 2.0 * s * scales;
    const Eigen::VectorXd left = scales / rest;
    sum += s * s * std::exp(-0.5 * rest.log().sum()) * (squares * left).squaredNorm();
  }
  return 3.0 * step * sum;
}

MixtureKurtosis::MixtureKurtosis(const NoiseResiduals & residuals)
  : m_Equal(NormalKurtosis(residuals))
{
  const UnequalFrames & frames = residuals.GetUnequalFrames();
  if (frames.AreEqual())
  {
    return;
  }
  m_IsEqual = false;
  m_Gain = frames.GetGain();
  m_OffsetDn = frames.GetOffsetDn();
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  m_Mean = frames.Autocovariance(basis, 0)(0) / residuals.GetDof();
  const Eigen::MatrixXd projection = Eigen::MatrixXd::Identity(basis.rows(), basis.rows()) - basis * basis.transpose();
  constexpr auto        size = static_cast<Eigen::Index>(Points);
  Eigen::MatrixXd       powers(size, size);
  Eigen::VectorXd       values(size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const double x = std::cos(3.14159265358979323846 * (static_cast<double>(k) + 0.5) / static_cast<double>(Points));
    const double root = 0.5 * (1.0 + x);
    const Eigen::VectorXd variance = 1.0 + (1.0 - root * root) * frames.GetGamma().array();
    values(k) = KurtosisOfNormal(projection * variance.asDiagonal() * projection);
    for (Eigen::Index j = 0; j < size; ++j)
    {
      powers(k, j) = std::pow(x, static_cast<double>(j));
    }
  }
  Eigen::Map<Eigen::VectorXd>(m_Polynomial.data(), size) = powers.fullPivLu().solve(values);
}

double
MixtureKurtosis::AtFraction(double shotFraction) const
{
  if (m_IsEqual)
  {
    return m_Equal;
  }
  const double x = 2.0 * std::sqrt(1.0 - std::min(1.0, std::max(0.0, shotFraction))) - 1.0;
  double       sum = 0.0;
  for (std::size_t j = Points; j-- > 0;)
  {
    sum = sum * x + m_Polynomial[j];
  }
  return sum;
}

double
MixtureKurtosis::ShotFraction(double lightDn, double weight) const
{
  const double shot = m_Gain * (lightDn - m_OffsetDn) * weight;
  return shot / (1.0 - m_Mean * shot);
}

} // namespace sensornoise
