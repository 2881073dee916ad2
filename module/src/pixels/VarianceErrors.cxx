// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"

#include "base/Eigen.h"
#include "pixels/VarianceLine.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * Errors and curvature of the line of VarianceFit. */

namespace sensornoise
{

namespace
{
/** Returns the covariance of (gain, intercept) from the sums of the squared weighted residuals times 1, x and x
 * squared, where x is the mean above the line's pivot. */
Eigen::Matrix2d
Sandwich(const VarianceLine & line, double squaresXX, double squaresX, double squares)
{
  // In the coordinates (gain, value at pivotDn) the information is diagonal.
  Eigen::Matrix2d inverse;
  inverse << 1.0 / line.spreadDn2, 0.0, 0.0, 1.0 / line.weightSum;
  Eigen::Matrix2d meat;
  meat << squaresXX, squaresX, squaresX, squares;
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -line.pivotDn, 1.0;
  return toIntercept * inverse * meat * inverse * toIntercept.transpose();
}
} // namespace

void
VarianceFit::FillErrors()
{
  if (!m_Line.isDetermined)
  {
    return;
  }
  // Sums of the squared weight times the squared residual R times powers of x, the mean above the pivot, and sums of
  // the weight times powers of x and R.
  enum : std::size_t
  {
    WWRR,
    WWRRX,
    WWRRXX,
    WX3,
    WX4,
    WXXR,
    Kept,
    W,
    WXX,
    Sums
  };
  const double atPivot = m_Line.intercept + m_Line.gain * m_Line.pivotDn;
  const auto   s = this->SumTerms<Sums>([atPivot, gain = m_Line.gain](double w, double x, double value) {
    const double residual = value - atPivot - gain * x;
    const double square = w * w * residual * residual;
    const double wxx = w * x * x;
    return std::array<double, Sums>{ square,      square * x,     square * x * x,      wxx * x,
                                     wxx * x * x, wxx * residual, w > 0.0 ? 1.0 : 0.0, w,
                                     wxx };
  });
  m_Line.covariance = Sandwich(m_Line, s[WWRRXX], s[WWRRX], s[WWRR]);
  const auto pixels = static_cast<double>(m_Dofs.values);
  // Quadratic column of the parabola, orthogonal to the first two columns: q = x^2 - a x - b.
  const double a = s[WX3] / s[WXX];
  const double b = s[WXX] / s[W];
  const double quadratic = s[WX4] - a * s[WX3] - b * s[WXX];
  if (quadratic > 0.0)
  {
    m_Line.curvature = s[WXXR] / quadratic;
    m_Line.curvatureSd = 1.0 / std::sqrt(quadratic);
    m_Line.curvatureTilt = a;
    m_Line.curvatureLift = b;
  }
  m_Line.trimmedFraction = (pixels - s[Kept]) / pixels;
  m_Line.isDetermined = std::isfinite(m_Line.gain) && m_Line.covariance.allFinite();
}

} // namespace sensornoise
