/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_refined_MotionReport_h
#define sensornoise_refined_MotionReport_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/series/OffsetLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace detail
{
/** \a offset: known, identified, or else the darkest level, minus the centre; \a offsetErrorDn how far it may be off.
 */
inline void
FillFlickerAndMotion(Report & report, const RefinedReportInput & input, double offset, double offsetErrorDn)
{
  const RefinedFindings & found = input.found;
  OffsetLine              line = found.line;
  line.UseOffset(offset);
  const auto frames = static_cast<double>(input.frames);
  report.flicker = line.gamma;
  const double noise = line.Widening() / line.precision;
  double       squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double variance = squares / (frames - 1.0) - noise;
  const double fromOffset = 2.0 * variance * line.sensitivity * offsetErrorDn;
  const double ownError =
    2.0 * std::sqrt(std::max(0.0, variance) * noise / (frames - 1.0)) + noise * std::sqrt(2.0 / (frames - 1.0));
  report.flickerSd = RootOf(variance, std::hypot(ownError, fromOffset), "1");
  if (found.local.series.cols() > 0 && !found.isOffsetDrift)
  {
    const double sd = found.localFlicker.Sd(offset);
    const double step = 1.0 + offsetErrorDn;
    const double slope = (found.localFlicker.Sd(offset + step) - found.localFlicker.Sd(offset - step)) / (2.0 * step);
    report.flickerSd = WithError(sd, std::hypot(slope * offsetErrorDn, sd * std::sqrt(noise)), "1");
  }

  const auto shift = [&](std::size_t stencil, std::size_t axis, Quantity & sd) {
    const auto &        stencils = found.motion.stencils;
    const auto          place = std::find(stencils.begin(), stencils.end(), stencil);
    std::vector<double> series;
    if (place == stencils.end())
    {
      sd = Quantity::Without(EstimateStatus::NotIdentifiable, "pixel");
      return series;
    }
    const auto k = static_cast<Eigen::Index>(place - stencils.begin());
    const auto spread = [&](const auto & coefficients, Eigen::Index column, double noiseSquare) {
      series.assign(input.frames, 0.0);
      double mean = 0.0;
      for (std::size_t t = 0; t < input.frames; ++t)
      {
        series[t] = coefficients(static_cast<Eigen::Index>(t), column) / (1.0 + line.gamma[t]);
        mean += series[t] / frames;
      }
      double sum = 0.0;
      for (double & value : series)
      {
        value -= mean;
        sum += value * value;
      }
      return sum / (frames - 1.0) - noiseSquare;
    };
    const double leastVariance = found.motion.covariance(k, k) * found.motionPhi;
    double       square = spread(found.motion.coefficients, k, leastVariance);
    double       error2 = leastVariance;
    double       systematic = 0.0;
    if (found.shifts)
    {
      const double leastSquares = std::sqrt(std::max(0.0, square));
      const auto   i = static_cast<Eigen::Index>(axis);
      error2 = found.shifts->covariance(i, i) * found.motionPhi;
      square = spread(found.shifts->coefficients, i, error2);
      systematic = 0.5 * std::abs(std::sqrt(std::max(0.0, square)) - leastSquares);
    }
    const double sdValue = std::sqrt(std::max(0.0, square));
    const double error = std::hypot(2.0 * sdValue * std::sqrt(error2 / (frames - 1.0)),
                                    error2 * std::sqrt(2.0 / (frames - 1.0)),
                                    2.0 * sdValue * systematic);
    sd = RootOf(square, error, "pixel");
    return series;
  };
  const std::vector<double> x = shift(StencilX, 0, report.vibrationSdX);
  const std::vector<double> y = shift(StencilY, 1, report.vibrationSdY);
  report.vibrationCovariance = Quantity::Without(EstimateStatus::NotIdentifiable, "pixel^2");
  if (!x.empty() && !y.empty())
  {
    double product = 0.0;
    for (std::size_t t = 0; t < input.frames; ++t)
    {
      report.motion.push_back({ x[t], y[t] });
      product += x[t] * y[t] / (frames - 1.0);
    }
    if (found.shifts)
    {
      product -= found.shifts->covariance(0, 1) * found.motionPhi;
    }
    report.vibrationCovariance = Quantity::Identified(product, "pixel^2");
  }
}
} // namespace detail

} // namespace sensornoise

#endif
