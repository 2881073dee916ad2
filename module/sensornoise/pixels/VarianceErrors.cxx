// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceFit.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * What VarianceFit knows of its line: the errors, the curvature, and what a part of the pixels says by itself. */

namespace sensornoise
{

namespace
{
/** The covariance of (gain, intercept) by the sums of the squared weighted residuals times 1, x and its square, x the
 * mean above the line's pivot. */
Eigen::Matrix2d
Sandwich(const VarianceLine & line, double squaresXX, double squaresX, double squares)
{
  // In coordinates (gain, value at pivotDn) the information is diagonal.
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
  // Sums of the weight and the residual R squared, times powers of x, the mean above the pivot; and of the weight times
  // powers of x and R.
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
  const auto   s = this->SumTerms<Sums>(m_Data.mask, [atPivot, gain = m_Line.gain](double w, double x, double value) {
    const double residual = value - atPivot - gain * x;
    const double square = w * w * residual * residual;
    const double wxx = w * x * x;
    return std::array<double, Sums>{ square,      square * x,     square * x * x,      wxx * x,
                                     wxx * x * x, wxx * residual, w > 0.0 ? 1.0 : 0.0, w,
                                     wxx };
  });
  m_Line.covariance = Sandwich(m_Line, s[WWRRXX], s[WWRRX], s[WWRR]);
  const auto pixels = static_cast<double>(m_Freedoms.values);
  // The parabola's third column, freed of the first two: q = x^2 - a x - b.
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

VarianceLine
VarianceFit::LineOfPart(const std::vector<std::uint8_t> & mask) const
{
  // Sums of the weight w times powers of x and the residual R about the line of all; of its square, the scores'.
  enum : std::size_t
  {
    Kept,
    W,
    WX,
    WXX,
    WR,
    WXR,
    WWRR,
    WWRRX,
    WWRRXX,
    Sums
  };
  const double pivot = m_Line.pivotDn;
  const double atPivot = m_Line.intercept + m_Line.gain * pivot;
  const auto   s = this->SumTerms<Sums>(mask.data(), [atPivot, gain = m_Line.gain](double w, double x, double value) {
    const double wr = w * (value - atPivot - gain * x);
    return std::array<double, Sums>{ w > 0.0 ? 1.0 : 0.0, w, w * x, w * x * x, wr, wr * x, wr * wr, wr * wr * x,
                                     wr * wr * x * x };
  });
  VarianceLine line;
  line.lowestDn2 = m_Line.lowestDn2;
  line.noiseSpreadDn4 = m_Line.noiseSpreadDn4;
  const double determinant = s[W] * s[WXX] - s[WX] * s[WX];
  line.isDetermined = s[Kept] >= static_cast<double>(InPixels.fewestPixelsOfFit) &&
                      determinant > InPixels.leastDeterminant * s[W] * s[WXX];
  if (line.isDetermined)
  {
    const double moreGain = (s[W] * s[WXR] - s[WX] * s[WR]) / determinant;
    const double centre = s[WX] / s[W];
    line.gain = m_Line.gain + moreGain;
    line.intercept = m_Line.intercept + (s[WXX] * s[WR] - s[WX] * s[WXR]) / determinant - moreGain * pivot;
    line.weightSum = s[W];
    line.pivotDn = pivot + centre;
    line.spreadDn2 = determinant / s[W];
    line.covariance = Sandwich(
      line, s[WWRRXX] - 2.0 * centre * s[WWRRX] + centre * centre * s[WWRR], s[WWRRX] - centre * s[WWRR], s[WWRR]);
    line.isDetermined = std::isfinite(line.gain) && line.covariance.allFinite();
  }
  return line;
}

} // namespace sensornoise
