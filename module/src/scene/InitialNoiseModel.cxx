// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/InitialNoiseModel.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "scene/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
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

namespace
{
constexpr std::size_t Bins = 32; // number of intensity bins

/** Returns the index of the pixel of the 3 x 3 pixels around \a p at column \a dx and row \a dy from it. */
std::size_t
Beside(std::size_t p, std::size_t width, int dx, int dy)
{
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) + StencilTap{ dx, dy, 1.0 }.Offset(width));
}
} // namespace

std::array<double, 2>
SquaredStepsNear(const double * mean, std::size_t width, std::size_t p)
{
  std::array<double, 2> largest{};
  for (int dy = -1; dy <= 1; ++dy)
  {
    for (int dx = -1; dx <= 1; ++dx)
    {
      const auto [gx, gy] = ApplyGradient(mean, width, Beside(p, width, dx, dy));
      largest[0] = std::max(largest[0], 4.0 * gx * gx);
      largest[1] = std::max(largest[1], 4.0 * gy * gy);
    }
  }
  return largest;
}

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
  sample.scale = std::max(1e-9, model.brightestDn - model.darkestDn);
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
    prediction.variance[i] = std::max(InScene.leastFractionOfDarkest * prediction.lowest, sample.TermsOf(i).dot(theta));
    prediction.keep[i] = sample.raw[i] < largestRatio * prediction.variance[i] ? 1 : 0;
  }
}

namespace
{
constexpr int Rounds = 5; // number of times that pixels are excluded and the coefficients are fitted again

/** The 3 x 3 pixels around a pixel. */
struct PixelSurroundings
{
  double                pixels{ 0.0 };   ///< number of usable ones
  double                variance{ 0.0 }; ///< sum of their variances [DN^2]
  std::array<double, 2> energy{};        ///< sums of their squared derivatives along x and y [DN^2/pixel^2]
  std::array<double, 2> squaredSteps{};  ///< see SquaredStepsNear() [DN^2]
};

PixelSurroundings
SurroundingsOf(const ReferenceFrame & frame, std::size_t p)
{
  const std::size_t width = frame.geometry.width;
  PixelSurroundings around;
  for (int dy = -1; dy <= 1; ++dy)
  {
    for (int dx = -1; dx <= 1; ++dx)
    {
      const std::size_t q = Beside(p, width, dx, dy);
      if (frame.usable[q] != 0)
      {
        const auto [gx, gy] = ApplyGradient(frame.mean.data(), width, q);
        around.pixels += 1.0;
        around.variance += frame.variance[q];
        around.energy[0] += gx * gx;
        around.energy[1] += gy * gy;
      }
    }
  }
  around.squaredSteps = SquaredStepsNear(frame.mean.data(), width, p);
  return around;
}

/** Returns the variance of the motion along \a axis that the sums over the surroundings of pixels show, given the
 * variance of each pixel without motion [pixel^2]; 0 if no derivatives are mainly along this axis. It is their median,
 * weighted by the squared derivatives, over the pixels whose derivatives are mainly along this axis. */
double
MotionAlong(const std::vector<PixelSurroundings> & surroundings,
            const std::vector<double> &            withoutMotion,
            std::size_t                            axis)
{
  std::vector<std::pair<double, double>> shown; // variance of the motion, weight
  double                                 sum = 0.0;
  for (std::size_t i = 0; i < surroundings.size(); ++i)
  {
    const PixelSurroundings & around = surroundings[i];
    const double              own = around.energy[axis];
    if (own > InScene.energyAlongAxis * around.energy[1 - axis])
    {
      shown.emplace_back((around.variance - around.pixels * withoutMotion[i]) / own, own);
      sum += own;
    }
  }
  std::sort(shown.begin(), shown.end());
  double below = 0.0;
  for (const auto & [variance, weight] : shown)
  {
    below += weight;
    if (below >= 0.5 * sum)
    {
      return std::max(0.0, variance);
    }
  }
  return 0.0;
}

/** A fit of the coefficients, and the pixels that it explains. */
struct ModelFit
{
  VarianceSample::Coefficients theta{ VarianceSample::Coefficients::Zero() };
  VariancePrediction           prediction;
};

/** Returns the fraction of the squared derivatives of the mean at pixels that \a prediction does not keep [1]. */
double
RejectedEnergy(const VarianceSample & sample, const VariancePrediction & prediction)
{
  double all = 0.0;
  double rejected = 0.0;
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    all += sample.energy[i];
    rejected += prediction.keep[i] == 0 ? sample.energy[i] : 0.0;
  }
  return all > 0.0 ? rejected / all : 0.0;
}

/** Returns the fraction of the smoother half of the pixels that \a prediction does not keep [1]. */
double
RejectedSmooth(const VarianceSample & sample, const VariancePrediction & prediction)
{
  const double middle = QuantileOf(sample.energy, 0.5);
  double       all = 0.0;
  double       rejected = 0.0;
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    const bool isSmooth = sample.energy[i] <= middle;
    all += isSmooth ? 1.0 : 0.0;
    rejected += isSmooth && prediction.keep[i] == 0 ? 1.0 : 0.0;
  }
  return rejected / all;
}

/** Keeps the pixels whose variance is below \a ratio times the largest that motion \a ofMotion along x and y [pixel^2]
 * explains, beside the variance without motion. */
void
KeepBelowSteps(const VarianceSample &                 sample,
               const std::vector<PixelSurroundings> & surroundings,
               const std::vector<double> &            withoutMotion,
               const std::array<double, 2> &          ofMotion,
               double                                 ratio,
               VariancePrediction &                   prediction)
{
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    const auto & steps = surroundings[i].squaredSteps;
    const double most = withoutMotion[i] + ofMotion[0] * steps[0] + ofMotion[1] * steps[1];
    prediction.keep[i] = sample.raw[i] < ratio * most ? 1 : 0;
  }
}

/** Returns whether the variances \a alongX and \a alongY [pixel^2] of the motion are those of a vibration, which are
 * not negative. Where the response is not linear the variance is no line of the level, and falls where the scene is
 * steep. */
bool
IsVibration(double alongX, double alongY)
{
  const auto [least, largest] = std::minmax(alongX, alongY);
  return largest > 0.0 && least > -InScene.negativeMotion * largest;
}

/** Fits the model to a scene whose edges are sharper than a pixel: the pixels are kept that the largest steps around
 * them explain, and the fit starts from the motion that sums over 3 x 3 pixels show. */
ModelFit
FitSharpScene(const ReferenceFrame &           frame,
              const std::vector<std::size_t> & pixels,
              VarianceSample                   sample,
              double                           ratio)
{
  std::vector<PixelSurroundings> surroundings;
  surroundings.reserve(pixels.size());
  for (const std::size_t p : pixels)
  {
    surroundings.push_back(SurroundingsOf(frame, p));
  }
  ModelFit              fit{ {}, StartFromMedians(sample) };
  std::vector<double>   withoutMotion = fit.prediction.variance;
  std::array<double, 2> motion{ MotionAlong(surroundings, withoutMotion, 0),
                                MotionAlong(surroundings, withoutMotion, 1) };
  KeepBelowSteps(sample, surroundings, withoutMotion, motion, ratio, fit.prediction);
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    fit.prediction.variance[i] += motion[0] * sample.TermsOf(i)(3) + motion[1] * sample.TermsOf(i)(4);
  }
  for (int round = 0; round < Rounds; ++round)
  {
    fit.theta = SolveKept(sample, fit.prediction);
    if (fit.theta(1) < 0.0 && fit.theta(2) > 0.0) // the terms of the level cancel at two levels, and describe the edges
    {
      sample.design.col(2).setZero();
      fit.theta = SolveKept(sample, fit.prediction);
    }
    Predict(sample, fit.theta, ratio, fit.prediction);
    motion = { std::max(0.0, fit.theta(3)), std::max(0.0, fit.theta(4)) };
    for (std::size_t i = 0; i < sample.Size(); ++i)
    {
      withoutMotion[i] = std::max(InScene.leastFractionOfDarkest * fit.prediction.lowest,
                                  sample.TermsOf(i).head<3>().dot(fit.theta.head<3>()));
    }
    KeepBelowSteps(sample, surroundings, withoutMotion, motion, ratio, fit.prediction);
  }
  return fit;
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
  const VarianceSample sample = SampleVariance(frame, pixels, model);
  ModelFit             fit{ {}, StartFromMedians(sample) };
  for (int round = 0; round < Rounds; ++round)
  {
    fit.theta = SolveKept(sample, fit.prediction);
    Predict(sample, fit.theta, model.largestRatio, fit.prediction);
  }
  const double rejected = RejectedEnergy(sample, fit.prediction);
  if (rejected > InScene.largestRejectedEnergy &&
      RejectedSmooth(sample, fit.prediction) < InScene.largestRejectedSmooth)
  {
    ModelFit sharp = FitSharpScene(frame, pixels, sample, model.largestRatio);
    model.isSharp = RejectedEnergy(sample, sharp.prediction) < InScene.largestRejectedEnergy &&
                    IsVibration(sharp.theta(3), sharp.theta(4));
    fit = model.isSharp ? std::move(sharp) : std::move(fit);
  }
  SetCoefficients(model, fit.theta, sample);
  return model;
}

} // namespace sensornoise
