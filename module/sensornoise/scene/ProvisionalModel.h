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
#ifndef sensornoise_scene_ProvisionalModel_h
#define sensornoise_scene_ProvisionalModel_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class ProvisionalModel
 * \brief A rough model of the uncorrected temporal variance, from the maps of the first pass alone: (2.20) of Sur &
 * Gredi\'ac 2015, robustly and with weights.
 *
 *     variance = intercept + slope x + sigma_gamma^2 x^2 + sigma_a^2 gx^2 + sigma_b^2 gy^2 + 2 sigma_ab gx gy
 *
 * with x the neighbours' mean above the darkest level, gx and gy the derivatives of the mean. It gives the weights of
 * everything that follows, the guard band at the clip levels, and the pixels that are no part of a static scene; never
 * an estimate that is reported. Estimator.md, 3.2. */
struct ProvisionalModel
{
  double darkestDn{ 0.0 };   ///< quantile 0.002 of the mean of the usable pixels
  double brightestDn{ 0.0 }; ///< quantile 0.998
  double averageDn{ 0.0 };   ///< mean of the usable pixels

  double interceptDn2{ 0.0 };      ///< variance at the darkest level
  double slopeDn{ 0.0 };           ///< about the gain
  double flickerVariance{ 0.0 };   ///< about sigma_gamma^2
  double vibrationXPixels2{ 0.0 }; ///< about sigma_alpha^2
  double vibrationYPixels2{ 0.0 };
  double vibrationXY{ 0.0 };

  /** Ratio of raw to modelled variance above which a pixel is not explained. */
  double largestRatio{ 0.0 };

  /** Variance without flicker and motion, at a neighbours' mean [DN^2]. */
  double
  NoiseVariance(double neighbourMeanDn) const
  {
    return interceptDn2 + slopeDn * std::max(0.0, neighbourMeanDn - darkestDn);
  }
  /** What motion adds at a gradient [DN^2]. */
  double
  MotionVariance(double gx, double gy) const
  {
    return vibrationXPixels2 * gx * gx + vibrationYPixels2 * gy * gy;
  }
  /** The whole uncorrected variance [DN^2]. */
  double
  RawVariance(double neighbourMeanDn, double gx, double gy) const
  {
    const double x = neighbourMeanDn - darkestDn;
    return NoiseVariance(neighbourMeanDn) + flickerVariance * x * x + MotionVariance(gx, gy) +
           2.0 * vibrationXY * gx * gy;
  }
};

/** Fits the model. It starts from the medians of 32 intensity bins of the smoother half of the pixels and trims pixels
 * whose variance is far above the model's five times. Throws std::runtime_error if fewer than 100 pixels are usable. */
inline ProvisionalModel
FitProvisionalModel(const ReferenceFrame & frame)
{
  const std::vector<std::size_t> sample = SamplePixels(frame.usable);
  const std::size_t              n = sample.size();
  if (n < 100)
  {
    throw std::runtime_error(
      "only " + std::to_string(n) +
      " pixels are free of clipping, with all their neighbours, and vary; expected at least 100");
  }
  const auto &        stencils = MotionStencils();
  ProvisionalModel    model;
  std::vector<double> level(n);
  std::vector<double> raw(n);
  std::vector<double> energy(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    level[i] = frame.mean[sample[i]];
    model.averageDn += level[i] / static_cast<double>(n);
  }
  model.darkestDn = Quantile(level, 0.002);
  model.brightestDn = Quantile(level, 0.998);
  const double scale = std::max(1e-9, model.brightestDn - model.darkestDn);

  constexpr int                                terms = 6;
  Eigen::Matrix<double, Eigen::Dynamic, terms> design(static_cast<Eigen::Index>(n), terms);
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t p = sample[i];
    const double      gx = ApplyStencil(stencils[StencilX], frame.mean.data(), frame.geometry.width, p);
    const double      gy = ApplyStencil(stencils[StencilY], frame.mean.data(), frame.geometry.width, p);
    const double      x = (frame.neighbourMean[p] - model.darkestDn) / scale;
    level[i] = frame.neighbourMean[p];
    raw[i] = frame.RawVariance(p);
    energy[i] = gx * gx + gy * gy;
    design.row(static_cast<Eigen::Index>(i)) << 1.0, x, x * x, gx * gx, gy * gy, gx * gy;
  }
  const std::vector<std::size_t> binOf = BinsOfEqualCount(level, 32);
  const double                   middleEnergy = QuantileOf(energy, 0.5);
  std::vector<double>            smooth;
  std::vector<std::size_t>       smoothBin;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (energy[i] <= middleEnergy)
    {
      smooth.push_back(raw[i]);
      smoothBin.push_back(binOf[i]);
    }
  }
  std::vector<double> medians = MediansOfBins(smooth, smoothBin, 32);
  double              largest = 0.0;
  double              lowest = 0.0;
  for (const double median : medians)
  {
    if (std::isfinite(median))
    {
      largest = std::max(largest, median);
      lowest = lowest == 0.0 ? median : std::min(lowest, median);
    }
  }

  model.largestRatio = std::max(2.5, 1.0 + 6.0 * std::sqrt(2.0 / static_cast<double>(frame.frames - 1)));
  std::vector<double>             predicted(n);
  std::vector<std::uint8_t>       keep(n);
  Eigen::Matrix<double, terms, 1> theta = Eigen::Matrix<double, terms, 1>::Zero();
  for (std::size_t i = 0; i < n; ++i)
  {
    const double median = medians[binOf[i]];
    predicted[i] = std::isfinite(median) ? median : largest;
    keep[i] = raw[i] < (energy[i] <= middleEnergy ? 2.5 : 30.0) * predicted[i] ? 1 : 0;
  }
  for (int round = 0; round < 5; ++round)
  {
    Eigen::Matrix<double, terms, terms> gram = Eigen::Matrix<double, terms, terms>::Zero();
    Eigen::Matrix<double, terms, 1>     right = Eigen::Matrix<double, terms, 1>::Zero();
    for (std::size_t i = 0; i < n; ++i)
    {
      if (keep[i] != 0)
      {
        const double w = 1.0 / (predicted[i] * predicted[i]);
        const auto   row = design.row(static_cast<Eigen::Index>(i));
        gram.noalias() += w * row.transpose() * row;
        right.noalias() += w * raw[i] * row.transpose();
      }
    }
    const Eigen::Matrix<double, terms, 1>     unit = (gram.diagonal().array() + 1e-300).rsqrt();
    const Eigen::Matrix<double, terms, terms> scaled = unit.asDiagonal() * gram * unit.asDiagonal();
    theta = unit.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(unit.asDiagonal() * right);
    for (std::size_t i = 0; i < n; ++i)
    {
      predicted[i] = std::max(0.2 * lowest, design.row(static_cast<Eigen::Index>(i)).dot(theta));
      keep[i] = raw[i] < model.largestRatio * predicted[i] ? 1 : 0;
    }
  }
  model.interceptDn2 = std::max({ theta(0), 0.3 * QuantileOf(raw, 0.001), 1e-3 * lowest });
  const double averageRaw = QuantileOf(raw, 0.5);
  const double averageX = std::max(1e-9, model.averageDn - model.darkestDn);
  model.slopeDn = theta(1) > 0.0 ? theta(1) / scale : 0.1 * averageRaw / averageX;
  model.flickerVariance = std::max(0.0, theta(2)) / (scale * scale);
  model.vibrationXPixels2 = std::max(0.0, theta(3));
  model.vibrationYPixels2 = std::max(0.0, theta(4));
  model.vibrationXY = 0.5 * theta(5);
  return model;
}

} // namespace sensornoise

#endif
