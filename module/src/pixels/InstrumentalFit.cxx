// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/InstrumentalFit.h"

#include "base/Eigen.h"
#include "pixels/Constants.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/VarianceFit.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

VarianceLine
FitInstrumental(const VarianceFit & fit, const VarianceData & data, const ReferenceFrame & frame)
{
  // Sums of the weight times x and v, the mean and the variance above the line at its pivot, and z, the mean of the
  // diagonal neighbours.
  enum : std::size_t
  {
    W,
    WX,
    WZ,
    WV,
    WZX,
    WZV,
    Sums
  };
  VarianceLine light = fit.GetLine();
  const double pivot = light.pivotDn;
  const auto   diagonalOf = [&](std::size_t p) {
    return DiagonalMean(frame.mean.data(), frame.geometry.width, p) - pivot;
  };
  const auto   s = fit.SumWeighed<Sums>([&](std::size_t p, const VarianceFit::Weighed & weighed, auto & sums) {
    if (HasDiagonals(frame.usable.data(), frame.geometry.width, p))
    {
      const auto [w, value] = weighed;
      const double x = data.mean[p] - pivot;
      const double z = diagonalOf(p);
      sums[W] += w;
      sums[WX] += w * x;
      sums[WZ] += w * z;
      sums[WV] += w * value;
      sums[WZX] += w * z * x;
      sums[WZV] += w * z * value;
    }
  });
  const double zMean = s[WZ] / s[W];
  const double common = s[WZX] - zMean * s[WX];
  light.isDetermined = common > 0.0;
  if (!light.isDetermined)
  {
    return light;
  }
  light.gain = (s[WZV] - zMean * s[WV]) / common;
  light.pivotDn = pivot + s[WX] / s[W];
  light.intercept = s[WV] / s[W] - light.gain * light.pivotDn;
  // Sums of the squared scores, for the sandwich covariance.
  const auto squares = fit.SumWeighed<3>([&](std::size_t p, const VarianceFit::Weighed & weighed, auto & sums) {
    if (HasDiagonals(frame.usable.data(), frame.geometry.width, p))
    {
      const auto [w, value] = weighed;
      const double score = w * (value - light.intercept - light.gain * data.mean[p]);
      const double z = diagonalOf(p) - zMean;
      sums[0] += score * score * z * z;
      sums[1] += score * score * z;
      sums[2] += score * score;
    }
  });
  // A pattern of columns or rows correlates the scores of their pixels: then whole columns or rows are independent.
  const std::size_t width = frame.geometry.width;
  const auto        alike = fit.SumWeighed(
    width + frame.geometry.height, [&](std::size_t p, const VarianceFit::Weighed & weighed, double * sums) {
      if (HasDiagonals(frame.usable.data(), frame.geometry.width, p))
      {
        const auto [w, value] = weighed;
        const double score = w * (value - light.intercept - light.gain * data.mean[p]) * (diagonalOf(p) - zMean);
        sums[p % width] += score;
        sums[width + p / width] += score;
      }
    });
  const auto      squaresOf = [&](auto first, auto last) { return std::inner_product(first, last, first, 0.0); };
  const auto      middle = alike.begin() + static_cast<std::ptrdiff_t>(width);
  const double    most = std::max(squaresOf(alike.begin(), middle), squaresOf(middle, alike.end()));
  const double    widening = most > InPattern.leastLikeness * squares[0] ? most / squares[0] : 1.0;
  Eigen::Matrix2d atPivot;
  atPivot << squares[0] / (common * common), squares[1] / (common * s[W]), squares[1] / (common * s[W]),
    squares[2] / (s[W] * s[W]);
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -light.pivotDn, 1.0;
  light.covariance = widening * toIntercept * atPivot * toIntercept.transpose();
  light.isDetermined = std::isfinite(light.gain) && light.covariance.allFinite();
  return light;
}

} // namespace sensornoise
