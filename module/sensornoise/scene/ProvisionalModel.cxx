// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/scene/ProvisionalModel.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/scene/VarianceSample.h"

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

void
SetCoefficients(ProvisionalModel &                   model,
                const VarianceSample::Coefficients & theta,
                const VarianceSample &               sample,
                double                               lowest)
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
  const VarianceSample         sample = SampleVariance(frame, pixels, model);
  VariancePrediction           prediction = StartFromMedians(sample);
  VarianceSample::Coefficients theta = VarianceSample::Coefficients::Zero();
  for (int round = 0; round < 5; ++round)
  {
    theta = SolveKept(sample, prediction);
    Predict(sample, theta, model.largestRatio, prediction);
  }
  SetCoefficients(model, theta, sample, prediction.lowest);
  return model;
}

} // namespace sensornoise
