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
#ifndef sensornoise_limits_CramerRaoBound_h
#define sensornoise_limits_CramerRaoBound_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/limits/CramerRaoInformation.h"
#include "sensornoise/limits/PrecisionLimit.h"
#include "sensornoise/simulation/SimulationSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

namespace detail
{
inline void
CheckCramerRaoInput(const CramerRaoInput & input)
{
  if (input.truth->settings.frames < 2)
  {
    throw std::invalid_argument("the stack has 1 frame; a variance in time needs at least 2");
  }
  if (input.truth->settings.rollingShutterPeriodRows > 0.0)
  {
    throw std::invalid_argument("the stack has a rolling shutter; the bound is for flicker that a frame has in common");
  }
  if (!(input.TotalReadVarianceDn2() > 0.0))
  {
    throw std::invalid_argument("read noise and rounding are both 0; a pixel without light needs some noise");
  }
}
} // namespace detail

/** The Cram\'er-Rao bound of a simulated stack, in the model that ComputePrecisionLimit() states: every pixel's flux,
 * every frame's flicker and every frame's shift are unknown. Mean and variance of every datum both count. The flicker
 * is (1 + gamma_t) / mean(1 + gamma) - 1 and the shifts are those less their mean: the rest is the scale and the
 * position of the scene, which no stack can tell.
 *
 * The shift's effect on a pixel is taken as known but for its size (the derivative of the interpolated scene), so the
 * vibrations' bound is a little too small: an estimator has only the frames' own noisy gradients.
 *
 * The work is 9 T^2 operations a pixel, 4 s of one core for 512 x 512 pixels and 100 frames; \a parallelFor spreads it
 * over up to 8 threads, with the same bits for any number. Memory: 8 times 72 T^2 bytes.
 *
 * \throws std::invalid_argument for one frame, a rolling shutter, or data without any noise in the dark. */
inline PrecisionLimit
ComputeCramerRaoBound(const CramerRaoInput & input, const ParallelFor & parallelFor = SerialFor)
{
  detail::CheckCramerRaoInput(input);
  const SimulationTruth &                truth = *input.truth;
  const CameraModel &                    camera = truth.settings.camera;
  const std::size_t                      pixels = input.width * input.height;
  const Eigen::Map<const Eigen::ArrayXd> electrons(input.electrons, static_cast<Eigen::Index>(pixels));
  const double                           meanFluxDn = input.MeanFluxPerElectronDn() * electrons.mean();

  constexpr std::size_t                  blocks = 8;
  std::vector<detail::SharedInformation> parts(blocks, { input, meanFluxDn });
  parallelFor(blocks, [&](std::size_t block) {
    for (std::size_t y = block * input.height / blocks; y < (block + 1) * input.height / blocks; ++y)
    {
      parts[block].AddRow(y);
    }
  });
  std::for_each(parts.begin() + 1, parts.end(), [&](const auto & part) { parts.front().Add(part); });

  using Shared = detail::SharedInformation;
  const Eigen::MatrixXd covariance = parts.front().GetCovariance();
  const Eigen::VectorXd units = parts.front().GetUnits();
  const auto            frames = static_cast<Eigen::Index>(truth.settings.frames);
  const auto            rootOf = [](double variance, double unitsSquared) {
    return variance < 1e15 * unitsSquared ? std::sqrt(variance) : PrecisionLimit::None;
  };
  const auto sdOf = [&](const Eigen::VectorXd & gradient) {
    return rootOf(gradient.dot(covariance * gradient), gradient.cwiseProduct(units).squaredNorm());
  };
  const auto sdOfFrame = [&](Eigen::Index series) {
    const Eigen::Index first = Shared::FirstSeries + series * frames;
    const auto         block = covariance.block(first, first, frames, frames);
    const auto         count = static_cast<double>(frames);
    return rootOf(block.trace() / count - block.sum() / (count * count), units.segment(first, frames).squaredNorm());
  };
  const auto sdOfSpread = [&](Eigen::Index series, const std::vector<double> & values, double spread) {
    const Eigen::Map<const Eigen::ArrayXd> v(values.data(), frames);
    Eigen::VectorXd                        gradient = Eigen::VectorXd::Zero(covariance.rows());
    gradient.segment(Shared::FirstSeries + series * frames, frames) =
      (v - v.mean()) / (static_cast<double>(frames - 1) * spread);
    return sdOf(gradient);
  };
  const auto gradientOf = [&](double gain, double centralVariance, double offset) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
    gradient(Shared::Gain) = gain;
    gradient(Shared::CentralVariance) = centralVariance;
    gradient(Shared::Offset) = offset;
    return gradient;
  };
  // sigma^2 - g mu = c0 - g (mean level), sigma^2 = c0 - g (mean level - mu).
  const Eigen::VectorXd intercept = gradientOf(-(camera.offsetDn + meanFluxDn), 1.0, 0.0);
  const Eigen::VectorXd readVariance = gradientOf(-meanFluxDn, 1.0, camera.gainDnPerElectron);

  PrecisionLimit limit;
  limit.gain = sdOf(gradientOf(1.0, 0.0, 0.0));
  limit.intercept = sdOf(intercept);
  limit.gainInterceptCorrelation = covariance.row(Shared::Gain).dot(intercept) / (limit.gain * limit.intercept);
  limit.offset = sdOf(gradientOf(0.0, 0.0, 1.0));
  limit.readNoise = camera.readNoiseDn > 0.0 ? sdOf(readVariance) / (2.0 * camera.readNoiseDn) : PrecisionLimit::None;
  limit.flickerOfFrame = sdOfFrame(0);
  limit.vibrationXOfFrame = sdOfFrame(1);
  limit.vibrationYOfFrame = sdOfFrame(2);
  limit.flickerSd = sdOfSpread(0, truth.normalisedFlicker, truth.realisedFlickerSd);
  limit.vibrationSdX = sdOfSpread(1, truth.series.alpha, truth.realisedVibrationSdXPixels);
  limit.vibrationSdY = sdOfSpread(2, truth.series.beta, truth.realisedVibrationSdYPixels);
  return limit;
}

} // namespace sensornoise

#endif
