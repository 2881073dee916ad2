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
#include "sensornoise/scene/ProvisionalModel.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr int         Terms = 6; // intercept, x, x^2, gx^2, gy^2, gx gy
constexpr std::size_t Bins = 32; // of intensity

using Coefficients = Eigen::Matrix<double, Terms, 1>;

/** The pixels of the fit. */
struct VarianceSample
{
  Eigen::Matrix<double, Eigen::Dynamic, Terms> design;
  std::vector<double>                          level;        // neighbours' mean [DN]
  std::vector<double>                          raw;          // variance [DN^2]
  std::vector<double>                          energy;       // square of the gradient
  double                                       scale{ 1.0 }; // of x in the design [DN]

  std::size_t
  Size() const
  {
    return raw.size();
  }
  auto
  TermsOf(std::size_t i) const
  {
    return design.row(static_cast<Eigen::Index>(i));
  }
};

/** What the fit predicts of every pixel, and which pixels it keeps. */
struct Prediction
{
  std::vector<double>       variance;
  std::vector<std::uint8_t> keep;
  double                    lowest{ 0.0 }; // median of a bin [DN^2]
};

void
SetLevels(ProvisionalModel & model, const ReferenceFrame & frame, const std::vector<std::size_t> & pixels)
{
  const std::size_t   n = pixels.size();
  std::vector<double> level(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    level[i] = frame.mean[pixels[i]];
    model.centreDn += level[i] / static_cast<double>(n);
  }
  model.darkestDn = Quantile(level, 0.002);
  model.brightestDn = Quantile(level, 0.998);
}

VarianceSample
SampleOf(const ReferenceFrame & frame, const std::vector<std::size_t> & pixels, const ProvisionalModel & model)
{
  const auto &      stencils = MotionStencils();
  const std::size_t n = pixels.size();
  VarianceSample    sample;
  sample.design.resize(static_cast<Eigen::Index>(n), Terms);
  sample.level.resize(n);
  sample.raw.resize(n);
  sample.energy.resize(n);
  sample.scale = std::max(1e-9, model.brightestDn - model.darkestDn);
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t p = pixels[i];
    const double      gx = ApplyStencil(stencils[StencilX], frame.mean.data(), frame.geometry.width, p);
    const double      gy = ApplyStencil(stencils[StencilY], frame.mean.data(), frame.geometry.width, p);
    const double      x = (frame.neighbourMean[p] - model.darkestDn) / sample.scale;
    sample.level[i] = frame.neighbourMean[p];
    sample.raw[i] = frame.RawVariance(p);
    sample.energy[i] = gx * gx + gy * gy;
    sample.design.row(static_cast<Eigen::Index>(i)) << 1.0, x, x * x, gx * gx, gy * gy, gx * gy;
  }
  return sample;
}

/** Starts from the medians over the bins of the smoother half of the pixels, where motion adds little. */
Prediction
StartFromMedians(const VarianceSample & sample)
{
  const std::vector<std::size_t> binOf = BinsOfEqualCount(sample.level, Bins);
  const double                   middleEnergy = QuantileOf(sample.energy, 0.5);
  std::vector<double>            smooth;
  std::vector<std::size_t>       smoothBin;
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    if (sample.energy[i] <= middleEnergy)
    {
      smooth.push_back(sample.raw[i]);
      smoothBin.push_back(binOf[i]);
    }
  }
  const std::vector<double> medians = MediansOfBins(smooth, smoothBin, Bins);
  Prediction                start;
  double                    largest = 0.0;
  for (const double median : medians)
  {
    if (std::isfinite(median))
    {
      largest = std::max(largest, median);
      start.lowest = start.lowest == 0.0 ? median : std::min(start.lowest, median);
    }
  }
  start.variance.resize(sample.Size());
  start.keep.resize(sample.Size());
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    const double median = medians[binOf[i]];
    start.variance[i] = std::isfinite(median) ? median : largest;
    start.keep[i] = sample.raw[i] < (sample.energy[i] <= middleEnergy ? 2.5 : 30.0) * start.variance[i] ? 1 : 0;
  }
  return start;
}

/** Weighted least squares over the pixels that are kept. */
Coefficients
SolveKept(const VarianceSample & sample, const Prediction & prediction)
{
  Eigen::Matrix<double, Terms, Terms> gram = Eigen::Matrix<double, Terms, Terms>::Zero();
  Coefficients                        right = Coefficients::Zero();
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    if (prediction.keep[i] != 0)
    {
      const double w = 1.0 / (prediction.variance[i] * prediction.variance[i]);
      const auto   terms = sample.TermsOf(i);
      gram.noalias() += w * terms.transpose() * terms;
      right.noalias() += w * sample.raw[i] * terms.transpose();
    }
  }
  const Coefficients                        unit = (gram.diagonal().array() + 1e-300).rsqrt();
  const Eigen::Matrix<double, Terms, Terms> scaled = unit.asDiagonal() * gram * unit.asDiagonal();
  return unit.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(unit.asDiagonal() * right);
}

void
SetCoefficients(ProvisionalModel & model, const Coefficients & theta, const VarianceSample & sample, double lowest)
{
  model.interceptDn2 = std::max({ theta(0), 0.3 * QuantileOf(sample.raw, 0.001), 1e-3 * lowest });
  const double averageRaw = QuantileOf(sample.raw, 0.5);
  const double averageX = std::max(1e-9, model.centreDn - model.darkestDn);
  model.slopeDn = theta(1) > 0.0 ? theta(1) / sample.scale : 0.1 * averageRaw / averageX;
  model.flickerVariance = std::max(0.0, theta(2)) / (sample.scale * sample.scale);
  model.vibrationXPixels2 = std::max(0.0, theta(3));
  model.vibrationYPixels2 = std::max(0.0, theta(4));
  model.vibrationXY = 0.5 * theta(5);
}
} // namespace

ProvisionalModel
FitProvisionalModel(const ReferenceFrame & frame)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  if (pixels.size() < 100)
  {
    throw NothingToMeasure("only " + std::to_string(pixels.size()) +
                           " pixels are free of clipping, with all their neighbours, and vary; expected at least 100");
  }
  ProvisionalModel model;
  SetLevels(model, frame, pixels);
  model.largestRatio = std::max(2.5, 1.0 + 6.0 * std::sqrt(2.0 / static_cast<double>(frame.frames - 1)));
  const VarianceSample sample = SampleOf(frame, pixels, model);
  Prediction           prediction = StartFromMedians(sample);
  Coefficients         theta = Coefficients::Zero();
  for (int round = 0; round < 5; ++round)
  {
    theta = SolveKept(sample, prediction);
    for (std::size_t i = 0; i < sample.Size(); ++i)
    {
      prediction.variance[i] = std::max(0.2 * prediction.lowest, sample.TermsOf(i).dot(theta));
      prediction.keep[i] = sample.raw[i] < model.largestRatio * prediction.variance[i] ? 1 : 0;
    }
  }
  SetCoefficients(model, theta, sample, prediction.lowest);
  return model;
}

} // namespace sensornoise
