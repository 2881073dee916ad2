// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/InitialNoiseModel.h"

#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "scene/Constants.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sensornoise
{

namespace
{
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

namespace
{
/** The 3 x 3 pixels around a pixel. */
struct PixelSurroundings
{
  double                pixels{ 0.0 };   ///< number of usable pixels
  double                variance{ 0.0 }; ///< sum of the variances of these pixels [DN^2]
  std::array<double, 2> energy{};        ///< sums of the squared derivatives along x and y [DN^2/pixel^2]
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

/** Returns the variance of the motion along \a axis from the sums over the surroundings of pixels [pixel^2]. The result
 * is a median over the pixels whose derivatives are mainly along this axis, weighted by the squared derivatives; 0 if
 * there are no pixels of this kind. \a withoutMotion has the variance of each pixel without motion. */
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

/** Returns the fraction of the pixels that \a prediction does not keep, where pixel i counts weightOf(i) [1]; 0 if all
 * weights are 0. */
template <typename TFunction>
double
RejectedFraction(const VariancePrediction & prediction, TFunction weightOf)
{
  double all = 0.0;
  double rejected = 0.0;
  for (std::size_t i = 0; i < prediction.keep.size(); ++i)
  {
    const double weight = weightOf(i);
    all += weight;
    rejected += prediction.keep[i] == 0 ? weight : 0.0;
  }
  return all > 0.0 ? rejected / all : 0.0;
}

/** Returns whether \a prediction leaves out so much of the squared derivatives of the mean that it cannot describe the
 * motion. */
bool
LeavesOutEdges(const VarianceSample & sample, const VariancePrediction & prediction)
{
  return RejectedFraction(prediction, [&](std::size_t i) { return sample.energy[i]; }) > InScene.largestRejectedEnergy;
}

/** Returns whether \a prediction keeps the smoother half of the pixels, where an object that moves would be, too. */
bool
KeepsSmoothPixels(const VarianceSample & sample, const VariancePrediction & prediction)
{
  const double middle = QuantileOf(sample.energy, 0.5);
  return RejectedFraction(prediction, [&](std::size_t i) { return sample.energy[i] <= middle ? 1.0 : 0.0; }) <
         InScene.largestRejectedSmooth;
}

/** Returns whether the variances \a alongX and \a alongY [pixel^2] of the motion fit a vibration: they are not
 * negative. If the response is non-linear, the variance is no line of the level, and falls where the scene is steep. */
bool
IsVibration(double alongX, double alongY)
{
  const auto [least, largest] = std::minmax(alongX, alongY);
  return largest > 0.0 && least > -InScene.negativeMotion * largest;
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

/** A fit of the coefficients, and the pixels that it explains. */
struct SharpFit
{
  VarianceSample::Coefficients theta{ VarianceSample::Coefficients::Zero() };
  VariancePrediction           prediction;
};

SharpFit
FitKeptBelowSteps(const std::vector<PixelSurroundings> & surroundings, VarianceSample sample, double ratio)
{
  SharpFit              fit{ {}, StartFromMedians(sample) };
  std::vector<double>   withoutMotion = fit.prediction.variance;
  std::array<double, 2> motion{ MotionAlong(surroundings, withoutMotion, 0),
                                MotionAlong(surroundings, withoutMotion, 1) };
  KeepBelowSteps(sample, surroundings, withoutMotion, motion, ratio, fit.prediction);
  for (std::size_t i = 0; i < sample.Size(); ++i)
  {
    fit.prediction.variance[i] += motion[0] * sample.TermsOf(i)(3) + motion[1] * sample.TermsOf(i)(4);
  }
  const double least = InCommon.lowestFraction * fit.prediction.lowest;
  for (int round = 0; round < InCommon.roundsOfExclusion; ++round)
  {
    fit.theta = SolveKept(sample, fit.prediction);
    if (fit.theta(1) < 0.0 && fit.theta(2) > 0.0) // the terms of the level cancel at two levels, and describe the edges
    {
      sample.design.col(2).setZero();
      fit.theta = SolveKept(sample, fit.prediction);
    }
    motion = { std::max(0.0, fit.theta(3)), std::max(0.0, fit.theta(4)) };
    for (std::size_t i = 0; i < sample.Size(); ++i)
    {
      const auto terms = sample.TermsOf(i);
      fit.prediction.variance[i] = std::max(least, terms.dot(fit.theta));
      withoutMotion[i] = std::max(least, terms.head<3>().dot(fit.theta.head<3>()));
    }
    KeepBelowSteps(sample, surroundings, withoutMotion, motion, ratio, fit.prediction);
  }
  return fit;
}
} // namespace

std::optional<VarianceSample::Coefficients>
FitSharpScene(const ReferenceFrame &           frame,
              const std::vector<std::size_t> & pixels,
              const VarianceSample &           sample,
              const VariancePrediction &       prediction,
              double                           ratio)
{
  if (!LeavesOutEdges(sample, prediction) || !KeepsSmoothPixels(sample, prediction))
  {
    return std::nullopt;
  }
  std::vector<PixelSurroundings> surroundings;
  surroundings.reserve(pixels.size());
  for (const std::size_t p : pixels)
  {
    surroundings.push_back(SurroundingsOf(frame, p));
  }
  const SharpFit fit = FitKeptBelowSteps(surroundings, sample, ratio);
  const bool     isSharp = !LeavesOutEdges(sample, fit.prediction) && IsVibration(fit.theta(3), fit.theta(4));
  return isSharp ? std::optional(fit.theta) : std::nullopt;
}

} // namespace sensornoise
