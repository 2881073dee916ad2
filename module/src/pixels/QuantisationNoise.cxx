// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/QuantisationNoise.h"

#include "base/Quantiles.h"
#include "moments/StackMaps.h"
#include "pixels/Constants.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t RemainderLevels = 513;

/** Returns the quantization noise of a pixel of the mean \a levelDn and the standard deviation \a sdDn [DN^2]: the
 * expectation over a normal distribution, by the five-point Gauss-Hermite rule. */
double
MeanVarianceAt(const QuantisationSteps & steps, double levelDn, double sdDn)
{
  constexpr std::array<double, 3> nodes{ 0.0, 1.3556261799742659, 2.8569700138728056 };
  constexpr std::array<double, 3> weights{ 0.53333333333333333, 0.22207592200561266, 0.01125741132772069 };
  double                          sum = weights[0] * steps.VarianceAt(levelDn);
  for (std::size_t k = 1; k < nodes.size(); ++k)
  {
    sum += weights[k] * (steps.VarianceAt(levelDn - nodes[k] * sdDn) + steps.VarianceAt(levelDn + nodes[k] * sdDn));
  }
  return sum;
}

/** Splits the excess into a line and a remainder. Before, remaindersDn2 holds the whole excess. The line is fitted to
 * the usable pixels with the weights of the variance fit. */
void
PartOffLine(QuantisationNoise & noise, const ReferenceFrame & frame, const InitialNoiseModel & model)
{
  double weight = 0.0, x = 0.0, xx = 0.0, v = 0.0, xv = 0.0;
  for (const std::size_t p : SamplePixels(frame.usable))
  {
    const double level = frame.neighbourMean[p] - model.centreDn;
    const double expected = model.NoiseVariance(frame.neighbourMean[p]);
    const double w = 1.0 / (expected * expected);
    const double value = noise.RemainderAt(frame.neighbourMean[p]);
    weight += w;
    x += w * level;
    xx += w * level * level;
    v += w * value;
    xv += w * level * value;
  }
  const double determinant = weight * xx - x * x;
  if (determinant > 0.0)
  {
    noise.slopeDn = (weight * xv - x * v) / determinant;
    noise.interceptDn2 = (v - noise.slopeDn * x) / weight - noise.slopeDn * model.centreDn;
    for (std::size_t i = 0; i < noise.remaindersDn2.size(); ++i)
    {
      noise.remaindersDn2[i] -=
        noise.interceptDn2 + noise.slopeDn * (noise.lowestDn + static_cast<double>(i) * noise.spacingDn);
    }
  }
}
} // namespace

QuantisationNoise
MakeQuantisationNoise(const DnRange &           dnRange,
                      const ReferenceFrame &    frame,
                      const InitialNoiseModel & model,
                      double                    darkStepDn)
{
  QuantisationNoise noise;
  noise.darkVarianceDn2 = dnRange.quantisationStepDn * dnRange.quantisationStepDn / 12.0;
  double brightestDn = -1.0;
  bool   isFirst = true;
  for (std::size_t p = 0; p < frame.usable.size() && dnRange.steps.IsCompanded(); ++p)
  {
    if (frame.usable[p] != 0)
    {
      noise.lowestDn = isFirst ? frame.mean[p] : std::min(noise.lowestDn, frame.mean[p]);
      brightestDn = isFirst ? frame.mean[p] : std::max(brightestDn, frame.mean[p]);
      isFirst = false;
    }
  }
  if (isFirst || !(brightestDn > noise.lowestDn))
  {
    return noise;
  }
  noise.darkVarianceDn2 =
    darkStepDn > 0.0 ? darkStepDn * darkStepDn / 12.0 : dnRange.steps.GetTable().front().varianceDn2;
  const double darkNoiseDn = std::sqrt(model.NoiseVariance(model.darkestDn));
  noise.darkErrorDn2 = InPixels.errorOfRounding * dnRange.steps.GetUnitDn() *
                       std::sqrt(darkNoiseDn * dnRange.steps.StepAt(model.darkestDn));
  noise.spacingDn = (brightestDn - noise.lowestDn) / static_cast<double>(RemainderLevels - 1);
  for (std::size_t i = 0; i < RemainderLevels; ++i)
  {
    const double level = noise.lowestDn + static_cast<double>(i) * noise.spacingDn;
    const double sd = std::sqrt(model.NoiseVariance(level));
    noise.remaindersDn2.push_back(MeanVarianceAt(dnRange.steps, level, sd) - noise.darkVarianceDn2);
  }
  PartOffLine(noise, frame, model);
  return noise;
}

Eigen::Matrix2d
QuantisationNoise::ErrorOfLine(double pivotDn) const
{
  const double    slope = InPixels.errorOfQuantisationNoise * slopeDn;
  Eigen::Matrix2d error;
  error << 1.0, -pivotDn, -pivotDn, pivotDn * pivotDn;
  error *= slope * slope;
  error(1, 1) += darkErrorDn2 * darkErrorDn2;
  return error;
}

StaticVariance
SubtractQuantisationLine(StaticVariance variance)
{
  const QuantisationNoise & noise = variance.quantisationNoise;
  for (VarianceLine * line :
       { &variance.line, &variance.instrumentalLine, &variance.curve.line, &variance.ofOwnLevels.line })
  {
    line->gain -= noise.slopeDn;
    line->intercept -= noise.interceptDn2;
    line->covariance += noise.ErrorOfLine(line->pivotDn);
  }
  return variance;
}

} // namespace sensornoise
