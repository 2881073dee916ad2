// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/InitialNoiseModel.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "base/Significance.h"
#include "scene/Constants.h"
#include "scene/VarianceSample.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
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
  model.brightestDn = Quantile(level, InCommon.brightestQuantile);
}

void
SetCoefficients(InitialNoiseModel & model, const VarianceSample::Coefficients & theta, const VarianceSample & sample)
{
  model.interceptDn2 = std::max(theta(0), InScene.leastIntercept * QuantileOf(sample.raw, InScene.quantileOfIntercept));
  const double averageRaw = QuantileOf(sample.raw, 0.5);
  const double averageX = std::max(1e-9, model.centreDn - model.darkestDn);
  model.slopeDn = theta(1) > 0.0 ? theta(1) / sample.scale : InScene.fallbackSlope * averageRaw / averageX;
  model.flickerVariance = std::max(0.0, theta(2)) / (sample.scale * sample.scale);
  model.vibrationXPixels2 = std::max(0.0, theta(3));
  model.vibrationYPixels2 = std::max(0.0, theta(4));
  model.vibrationXY = 0.5 * theta(5);
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
  VariancePrediction           prediction = StartFromMedians(sample);
  VarianceSample::Coefficients theta = VarianceSample::Coefficients::Zero();
  for (int round = 0; round < 5; ++round)
  {
    theta = SolveKept(sample, prediction);
    Predict(sample, theta, model.largestRatio, prediction);
  }
  SetCoefficients(model, theta, sample);
  return model;
}

} // namespace sensornoise
