// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/InitialNoiseModel.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "base/Text.h"
#include "scene/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
void
SetLevels(InitialNoiseModel & model, const ReferenceFrame & frame, const std::vector<std::size_t> & pixels)
{
  const std::size_t   n = pixels.size();
  std::vector<double> level(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    level[i] = frame.mean[pixels[i]];
    model.centreDn += level[i] / static_cast<double>(n);
  }
  model.darkestDn = Quantile(level, InCommon.darkestQuantile);
  model.brightestDn = Quantile(level, 1.0 - InCommon.darkestQuantile);
}

void
SetCoefficients(InitialNoiseModel & model, const VarianceSample::Coefficients & theta, const VarianceSample & sample)
{
  model.interceptDn2 = std::max(theta(0), InScene.leastIntercept * QuantileOf(sample.raw, InScene.quantileOfIntercept));
  const double averageRaw = QuantileOf(sample.raw, 0.5);
  const double averageX = std::max(smallestDivisor, model.centreDn - model.darkestDn);
  model.slopeDn = theta(1) > 0.0 ? theta(1) / sample.scale : InScene.fallbackSlope * averageRaw / averageX;
  model.flickerVariance = std::max(0.0, theta(2)) / (sample.scale * sample.scale);
  model.vibrationXPixels2 = std::max(0.0, theta(3));
  model.vibrationYPixels2 = std::max(0.0, theta(4));
  model.vibrationXY = 0.5 * theta(5);
}

/** Returns the mean of the raw variances if neither level nor derivatives explain their differences by more than
 * chance, as in a flat field: a fit would extrapolate noise. */
std::optional<double>
FindUniformVariance(const VarianceSample & sample, double largestRatio)
{
  VarianceSample::Coefficients median = VarianceSample::Coefficients::Zero();
  median(0) = QuantileOf(sample.raw, 0.5);
  VariancePrediction uniform;
  Predict(sample, median, largestRatio, uniform);
  double count = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    count += uniform.keep[i];
    mean += uniform.keep[i] * (sample.raw[i] - mean) / std::max(1.0, count);
  }
  const VarianceSample::Coefficients theta = SolveKept(sample, uniform);
  double                             explained = 0.0;
  double                             left = 0.0;
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    const double predicted = sample.TermsOf(i).dot(theta);
    explained += uniform.keep[i] * (predicted - mean) * (predicted - mean);
    left += uniform.keep[i] * (sample.raw[i] - predicted) * (sample.raw[i] - predicted);
  }
  constexpr double dof = VarianceSample::Terms - 1.0;
  const double     byChance = left / std::max(1.0, count - VarianceSample::Terms);
  const bool       isUniform = explained < byChance * (dof + Significance.severalTests * std::sqrt(2.0 * dof));
  return isUniform ? std::optional<double>(mean) : std::nullopt;
}
} // namespace

InitialNoiseModel
FitInitialNoiseModel(const ReferenceFrame & frame)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  if (pixels.size() < InScene.fewestPixels)
  {
    throw NothingToMeasure("only " + std::to_string(pixels.size()) +
                           " pixels vary and are not clipped, with all their neighbours; expected at least " +
                           std::to_string(InScene.fewestPixels) +
                           ". Record a scene between the clip levels, or correct --mask, --roi or --clip");
  }
  InitialNoiseModel model;
  SetLevels(model, frame, pixels);
  model.largestRatio = std::max(InScene.largestRatio,
                                1.0 + Significance.everyPixel * std::sqrt(2.0 / static_cast<double>(frame.frames - 1)));
  const VarianceSample         sample = SampleVariance(frame, pixels, model);
  VarianceSample::Coefficients theta = VarianceSample::Coefficients::Zero();
  if (const std::optional<double> uniform = FindUniformVariance(sample, model.largestRatio))
  {
    theta(0) = *uniform;
    SetCoefficients(model, theta, sample);
    return model;
  }
  VariancePrediction prediction = StartFromMedians(sample);
  for (int round = 0; round < InCommon.roundsOfExclusion; ++round)
  {
    theta = SolveKept(sample, prediction);
    Predict(sample, theta, model.largestRatio, prediction);
  }
  if (const auto sharp = FitSharpScene(frame, pixels, sample, prediction, model.largestRatio))
  {
    theta = *sharp;
    model.isSharp = true;
  }
  SetCoefficients(model, theta, sample);
  return model;
}

namespace
{
constexpr std::size_t Bins = 32; // number of intensity bins
} // namespace

VarianceSample
SampleVariance(const ReferenceFrame & frame, const std::vector<std::size_t> & pixels, const InitialNoiseModel & model)
{
  const auto &      stencils = MotionStencils();
  const std::size_t n = pixels.size();
  VarianceSample    sample;
  sample.design.resize(static_cast<Eigen::Index>(n), VarianceSample::Terms);
  sample.level.resize(n);
  sample.raw.resize(n);
  sample.energy.resize(n);
  sample.scale = std::max(smallestDivisor, model.brightestDn - model.darkestDn);
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t p = pixels[i];
    const double      gx = ApplyStencil(stencils[StencilX], frame.mean.data(), frame.geometry.width, p);
    const double      gy = ApplyStencil(stencils[StencilY], frame.mean.data(), frame.geometry.width, p);
    const double      x = (frame.neighbourMean[p] - model.darkestDn) / sample.scale;
    sample.level[i] = frame.neighbourMean[p];
    sample.raw[i] = frame.variance[p];
    sample.energy[i] = gx * gx + gy * gy;
    sample.design.row(static_cast<Eigen::Index>(i)) << 1.0, x, x * x, gx * gx, gy * gy, gx * gy;
  }
  return sample;
}

VariancePrediction
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
  VariancePrediction        start;
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
    start.keep[i] =
      sample.raw[i] <
          (sample.energy[i] <= middleEnergy ? InScene.largestRatio : InScene.startRatioRough) * start.variance[i]
        ? 1
        : 0;
  }
  return start;
}

VarianceSample::Coefficients
SolveKept(const VarianceSample & sample, const VariancePrediction & prediction)
{
  using Gram = Eigen::Matrix<double, VarianceSample::Terms, VarianceSample::Terms>;
  Gram                         gram = Gram::Zero();
  VarianceSample::Coefficients right = VarianceSample::Coefficients::Zero();
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
  const VarianceSample::Coefficients unit = (gram.diagonal().array() + 1e-300).rsqrt();
  const Gram                         scaled = unit.asDiagonal() * gram * unit.asDiagonal();
  return unit.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(unit.asDiagonal() * right);
}

void
Predict(const VarianceSample &               sample,
        const VarianceSample::Coefficients & theta,
        double                               largestRatio,
        VariancePrediction &                 prediction)
{
  prediction.variance.resize(sample.Size());
  prediction.keep.resize(sample.Size());
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    prediction.variance[i] = std::max(InCommon.lowestFraction * prediction.lowest, sample.TermsOf(i).dot(theta));
    prediction.keep[i] = sample.raw[i] < largestRatio * prediction.variance[i] ? 1 : 0;
  }
}

void
RequireUnitOfFrames(const InitialNoiseModel & model)
{
  // The noise correlation sums squares of up to 256 values of six standard deviations in single precision: with these
  // limits they are within its range, from 1e-38 to 3e38.
  constexpr double smallest = 1e-16;
  constexpr double largest = 1e16;
  const double     noise = std::sqrt(model.NoiseVariance(model.centreDn));
  if (noise < smallest || noise > largest)
  {
    throw NothingToMeasure(
      "the standard deviation of the noise is " + Text(noise) +
      " in the unit of the frames; expected 1e-16 to 1e+16. Multiply the frames by a constant, such as " +
      Text(std::pow(10.0, -std::floor(std::log10(noise)))));
  }
}

} // namespace sensornoise
