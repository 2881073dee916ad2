// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoBound.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{
namespace
{
/** Returns the standard error of sigma from the errors of g, c = sigma^2 - g mu and mu, to first order:
 * sigma^2 = c + g mu, and the error of mu is independent of the errors of g and c. Infinite for sigma = 0. */
double
ReadNoiseLimit(const PrecisionLimit & limit, double gainDnPerElectron, double offsetDn, double readVarianceDn2)
{
  const double covariance = limit.gainInterceptCorrelation * limit.gain * limit.intercept;
  const double offsetTerm = gainDnPerElectron * limit.offset;
  const double variance = limit.intercept * limit.intercept + offsetDn * offsetDn * limit.gain * limit.gain +
                          2.0 * offsetDn * covariance + offsetTerm * offsetTerm;
  return readVarianceDn2 > 0.0 ? std::sqrt(variance / (4.0 * readVarianceDn2)) : PrecisionLimit::None;
}

/** Sums over the pixels used. The flux is q = mean - mu, the noise variance V = g q + s. */
struct PrecisionSums
{
  double a0{ 0.0 };         ///< sum 1/V
  double a1{ 0.0 };         ///< sum q/V
  double a2{ 0.0 };         ///< sum q^2/V
  double w0{ 0.0 };         ///< sum 1/V^2
  double w1{ 0.0 };         ///< sum mean/V^2
  double gradientsX{ 0.0 }; ///< sum (d mean/dx)^2/V, central differences
  double gradientsY{ 0.0 }; ///< sum (d mean/dy)^2/V
};

/** Calls \a visit(p, flux, variance) for every pixel that is used and has a positive noise variance. */
template <typename TVisit>
void
ForEachUsedPixel(const PrecisionInput & input, TVisit visit)
{
  for (std::size_t p = 0; p < input.width * input.height; ++p)
  {
    const double flux = input.mean[p] - input.offsetDn;
    const double variance = input.gainDnPerElectron * flux + input.totalReadVarianceDn2;
    if ((input.mask == nullptr || input.mask[p] != 0) && variance > 0.0)
    {
      visit(p, flux, variance);
    }
  }
}

PrecisionSums
SumPrecision(const PrecisionInput & input)
{
  PrecisionSums sums;
  const auto    addGradient = [&](double & sum, std::size_t p, std::size_t step, double variance) {
    const double difference = 0.5 * (input.mean[p + step] - input.mean[p - step]);
    sum += std::isfinite(difference) ? difference * difference / variance : 0.0;
  };
  ForEachUsedPixel(input, [&](std::size_t p, double flux, double variance) {
    sums.a0 += 1.0 / variance;
    sums.a1 += flux / variance;
    sums.a2 += flux * flux / variance;
    sums.w0 += 1.0 / (variance * variance);
    sums.w1 += input.mean[p] / (variance * variance);
    const std::size_t x = p % input.width;
    const std::size_t y = p / input.width;
    if (x > 0 && x + 1 < input.width)
    {
      addGradient(sums.gradientsX, p, 1, variance);
    }
    if (y > 0 && y + 1 < input.height)
    {
      addGradient(sums.gradientsY, p, input.width, variance);
    }
  });
  return sums;
}

/** Sums over the pixels used of the squared deviations of the levels from m, and of the fluxes from a constant flux. */
struct DeviationSums
{
  double levelDeviation{ 0.0 }; ///< sum (ubar - m)^2 / V^2
  double contrast{ 0.0 };       ///< A0 - A1^2/A2 = sum (1 - q A1/A2)^2 / V, without cancellation
  double levelMagnitude{ 0.0 }; ///< sum ubar^2 / V^2
};

/** Computes the sums. \a centreDn is m [DN], \a fluxRatio is A1/A2 [1/DN]. */
DeviationSums
SumDeviations(const PrecisionInput & input, double centreDn, double fluxRatio)
{
  DeviationSums sums;
  ForEachUsedPixel(input, [&](std::size_t p, double flux, double variance) {
    const double deviation = (input.mean[p] - centreDn) / variance;
    const double level = input.mean[p] / variance;
    const double residual = 1.0 - flux * fluxRatio;
    sums.levelDeviation += deviation * deviation;
    sums.levelMagnitude += level * level;
    sums.contrast += residual * residual / variance;
  });
  return sums;
}
} // namespace

PrecisionLimit
ComputePrecisionLimit(const PrecisionInput & input)
{
  if (input.frames < 2)
  {
    throw std::invalid_argument("the stack has " + std::to_string(input.frames) +
                                " frames; a variance in time needs at least 2");
  }
  if (!(input.gainDnPerElectron > 0.0))
  {
    throw std::invalid_argument("the gain is " + std::to_string(input.gainDnPerElectron) +
                                " DN/e-; expected a positive number");
  }
  PrecisionLimit      limit;
  const PrecisionSums sums = SumPrecision(input);
  if (!(sums.a2 > 0.0))
  {
    return limit;
  }
  const double        centreDn = sums.w1 / sums.w0;
  const double        fluxRatio = sums.a1 / sums.a2;
  const DeviationSums deviations = SumDeviations(input, centreDn, fluxRatio);
  // A scene of one level leaves rounding errors of 1e-32 here.
  constexpr double rounding = 1e-20;
  const double     dof = static_cast<double>(input.frames - 1);
  if (deviations.levelDeviation > rounding * deviations.levelMagnitude)
  {
    const double gainVariance = 2.0 / (dof * deviations.levelDeviation);
    limit.gain = std::sqrt(gainVariance);
    limit.intercept = std::sqrt(2.0 / (dof * sums.w0) + centreDn * centreDn * gainVariance);
    limit.gainInterceptCorrelation = -centreDn * limit.gain / limit.intercept;
  }
  limit.flickerOfFrame = 1.0 / std::sqrt(sums.a2);
  if (deviations.contrast > rounding * sums.a0)
  {
    const double offsetOfUnitFlicker = 1.0 / std::sqrt(dof * deviations.contrast); // sigma_gamma sd(mu)
    limit.offset = offsetOfUnitFlicker / input.flickerSd;
    limit.flickerSd = std::hypot(limit.flickerOfFrame / std::sqrt(dof), fluxRatio * offsetOfUnitFlicker);
  }
  if (std::isfinite(limit.gain) && std::isfinite(limit.offset))
  {
    const double roundingDn2 = input.quantisationStepDn * input.quantisationStepDn / 12.0;
    limit.readNoise =
      ReadNoiseLimit(limit, input.gainDnPerElectron, input.offsetDn, input.totalReadVarianceDn2 - roundingDn2);
  }
  limit.vibrationXOfFrame = 1.0 / std::sqrt(sums.gradientsX);
  limit.vibrationYOfFrame = 1.0 / std::sqrt(sums.gradientsY);
  limit.vibrationSdX = limit.vibrationXOfFrame / std::sqrt(dof);
  limit.vibrationSdY = limit.vibrationYOfFrame / std::sqrt(dof);
  return limit;
}

} // namespace sensornoise
