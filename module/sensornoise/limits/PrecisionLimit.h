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
#ifndef sensornoise_limits_PrecisionLimit_h
#define sensornoise_limits_PrecisionLimit_h

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise
{

/** The smallest standard deviations that an unbiased estimate from one stack can have (Cram\'er-Rao). Infinity:
 * the stack does not identify the quantity. "Flicker" and "vibration" are those that the stack really had, not the
 * population's that they were drawn from: gamma_t = (1 + gamma_t) / mean(1 + gamma) - 1 and the shifts less their
 * mean. */
struct PrecisionLimit
{
  static constexpr double None = std::numeric_limits<double>::infinity();

  double gain{ None };                     ///< g [DN/e-]
  double intercept{ None };                ///< sigma^2 - g mu [DN^2]
  double offset{ None };                   ///< mu [DN]
  double readNoise{ None };                ///< sigma [DN]
  double flickerOfFrame{ None };           ///< gamma_t [1]; root mean square over the frames
  double flickerSd{ None };                ///< sigma_gamma [1]
  double vibrationXOfFrame{ None };        ///< alpha_t [pixel]; root mean square over the frames
  double vibrationYOfFrame{ None };        ///< beta_t [pixel]; root mean square over the frames
  double vibrationSdX{ None };             ///< sigma_alpha [pixel]
  double vibrationSdY{ None };             ///< sigma_beta [pixel]
  double gainInterceptCorrelation{ -1.0 }; ///< of the errors of g and sigma^2 - g mu
};

/** What the precision of a stack depends on. */
struct PrecisionInput
{
  const double *       mean;   ///< expected level of every pixel, offset included [DN]
  const std::uint8_t * mask;   ///< nonzero where the pixel is used; null: everywhere
  std::size_t          width;  ///< columns
  std::size_t          height; ///< rows

  double gainDnPerElectron;
  double offsetDn;
  /** sigma^2, and step^2 / 12 where the grey levels are whole codes [DN^2]. */
  double totalReadVarianceDn2;
  /** Distance of the codes [DN]; 0: the grey levels are not rounded. */
  double      quantisationStepDn;
  std::size_t frames;    ///< T, at least 2
  double      flickerSd; ///< sigma_gamma of the frames themselves [1]
};

namespace detail
{
/** sd of sigma from the errors of g, c = sigma^2 - g mu and mu, to first order: sigma^2 = c + g mu, and mu has no error
 * in common with g and c. Infinite for sigma = 0. */
inline double
ReadNoiseLimit(const PrecisionLimit & limit, double gainDnPerElectron, double offsetDn, double readVarianceDn2)
{
  const double covariance = limit.gainInterceptCorrelation * limit.gain * limit.intercept;
  const double offsetTerm = gainDnPerElectron * limit.offset;
  const double variance = limit.intercept * limit.intercept + offsetDn * offsetDn * limit.gain * limit.gain +
                          2.0 * offsetDn * covariance + offsetTerm * offsetTerm;
  return readVarianceDn2 > 0.0 ? std::sqrt(variance / (4.0 * readVarianceDn2)) : PrecisionLimit::None;
}

/** Sums over the pixels used: the flux is q = mean - mu, the noise variance V = g q + s. */
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

/** Calls \a visit(p, flux, variance) for every pixel used whose noise variance is positive. */
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

inline PrecisionSums
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
} // namespace detail

/** The precision limit in closed form, from sums over the pixels: enough to plan an experiment with, and to judge an
 * estimator by. With the model of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035), (2.1), in its normal
 * approximation,
 *
 *   u_xt ~ N(mu + L_xt, g L_xt + s),   L_xt = (1 + gamma_t) q_x(alpha_t, beta_t),   s = sigma^2 + step^2 / 12,
 *
 * the Fisher information of a datum for two parameters a, b is m_a m_b / V + V_a V_b / (2 V^2), m and V being its mean
 * and variance (Kay, Fundamentals of Statistical Signal Processing, vol. 1, 1993, (3.31)). With q_x, gamma_t and the
 * shifts all unknown and only the leading terms kept, it inverts to
 *
 *   var(g)           = 2 / ((T-1) sum (ubar - m)^2 / V^2),   m = sum (ubar/V^2) / sum (1/V^2)
 *   var(c)           = 2 / ((T-1) sum 1/V^2) + m^2 var(g),   c = sigma^2 - g mu,   cov(g, c) = -m var(g)
 *   var(mu)          = 1 / ((T-1) sigma_gamma^2 (A0 - A1^2/A2)),   A_k = sum q^k / V
 *   var(sigma^2)     = var(c) + mu^2 var(g) + 2 mu cov(g, c) + g^2 var(mu)
 *   var(gamma_t)     = 1 / A2
 *   var(sigma_gamma) = 1 / ((T-1) A2) + (sigma_gamma (A1/A2) sd(mu))^2
 *   var(alpha_t)     = 1 / sum (d ubar/dx)^2 / V,   var(sigma_alpha) = var(alpha_t) / (T-1);   beta_t likewise.
 *
 * With 100 frames and vibrations below a pixel these agree with ComputeCramerRaoBound() within 3 % but for the
 * vibrations, which can differ by 25 %. Twice the flicker halves sd(mu); the dark pixels, of small V, make A0 large.
 *
 * \throws std::invalid_argument if there are fewer than 2 frames, or the gain is not positive. */
inline PrecisionLimit
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
  PrecisionLimit              limit;
  const detail::PrecisionSums sums = detail::SumPrecision(input);
  if (!(sums.a2 > 0.0))
  {
    return limit;
  }
  const double centreDn = sums.w1 / sums.w0;
  const double fluxRatio = sums.a1 / sums.a2;
  double       levelSpread = 0.0;    // sum (ubar - m)^2 / V^2
  double       contrast = 0.0;       // A0 - A1^2/A2 = sum (1 - q A1/A2)^2 / V, without the cancellation
  double       levelMagnitude = 0.0; // sum ubar^2 / V^2
  detail::ForEachUsedPixel(input, [&](std::size_t p, double flux, double variance) {
    const double deviation = (input.mean[p] - centreDn) / variance;
    const double level = input.mean[p] / variance;
    const double residual = 1.0 - flux * fluxRatio;
    levelSpread += deviation * deviation;
    levelMagnitude += level * level;
    contrast += residual * residual / variance;
  });
  // A scene of one level leaves rounding errors of 1e-32 here.
  constexpr double rounding = 1e-20;
  const double     degreesOfFreedom = static_cast<double>(input.frames - 1);
  if (levelSpread > rounding * levelMagnitude)
  {
    const double gainVariance = 2.0 / (degreesOfFreedom * levelSpread);
    limit.gain = std::sqrt(gainVariance);
    limit.intercept = std::sqrt(2.0 / (degreesOfFreedom * sums.w0) + centreDn * centreDn * gainVariance);
    limit.gainInterceptCorrelation = -centreDn * limit.gain / limit.intercept;
  }
  limit.flickerOfFrame = 1.0 / std::sqrt(sums.a2);
  if (contrast > rounding * sums.a0)
  {
    const double offsetOfUnitFlicker = 1.0 / std::sqrt(degreesOfFreedom * contrast); // sigma_gamma sd(mu)
    limit.offset = offsetOfUnitFlicker / input.flickerSd;
    limit.flickerSd = std::hypot(limit.flickerOfFrame / std::sqrt(degreesOfFreedom), fluxRatio * offsetOfUnitFlicker);
  }
  if (std::isfinite(limit.gain) && std::isfinite(limit.offset))
  {
    const double rounding12 = input.quantisationStepDn * input.quantisationStepDn / 12.0;
    limit.readNoise =
      detail::ReadNoiseLimit(limit, input.gainDnPerElectron, input.offsetDn, input.totalReadVarianceDn2 - rounding12);
  }
  limit.vibrationXOfFrame = 1.0 / std::sqrt(sums.gradientsX);
  limit.vibrationYOfFrame = 1.0 / std::sqrt(sums.gradientsY);
  limit.vibrationSdX = limit.vibrationXOfFrame / std::sqrt(degreesOfFreedom);
  limit.vibrationSdY = limit.vibrationYOfFrame / std::sqrt(degreesOfFreedom);
  return limit;
}

} // namespace sensornoise

#endif
