// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "stabilise/NoiseModelCheck.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sensornoise
{

namespace
{
/** Limit of the integration of a normal distribution [standard deviations]: the probability beyond is less than
 * 1e-23. */
constexpr double Reach = 10.0;

double
NormalDensity(double n)
{
  return std::exp(-0.5 * n * n) * 0.39894228040143268;
}

double
NormalDistribution(double n)
{
  return 0.5 * std::erfc(-n * 0.70710678118654752);
}

/** Returns E sqrt(max(0, m + s n)) for standard normal n. The trapezoidal rule is exact but for rounding if the
 * integrand is analytic and vanishes at both ends. The integral is over n if the branch point of the root is out of
 * reach, else over w = sqrt(m + s n), in which the integrand is even and analytic. */
double
MeanRoot(double m, double s)
{
  if (s == 0.0)
  {
    return std::sqrt(std::max(0.0, m));
  }
  double sum = 0.0;
  if (m > (Reach + 2.0) * s)
  {
    constexpr int    nodes = 80;
    constexpr double step = 2.0 * Reach / nodes;
    for (int i = 0; i <= nodes; ++i)
    {
      const double n = i * step - Reach;
      sum += std::sqrt(m + s * n) * NormalDensity(n);
    }
    return sum * step;
  }
  constexpr int nodes = 800;
  const double  step = std::sqrt(std::max(0.0, m + Reach * s)) / nodes;
  for (int i = 1; i <= nodes; ++i) // the integrand is 0 at w = 0
  {
    const double w = i * step;
    sum += 2.0 * w * w * NormalDensity((w * w - m) / s) / s;
  }
  return sum * step;
}

/** Returns E max(0, m + s n) for standard normal n. */
double
MeanArgument(double m, double s)
{
  return s == 0.0 ? std::max(0.0, m) : m * NormalDistribution(m / s) + s * NormalDensity(m / s);
}
} // namespace

StabilisedMoments
MomentsOfStabilised(double electrons, double readNoiseElectrons)
{
  if (!(electrons >= 0.0 && electrons <= 1e6 && readNoiseElectrons >= 0.0 && readNoiseElectrons <= 1000.0))
  {
    throw std::invalid_argument("the law of " + Text(electrons) + " electrons and a read noise of " +
                                Text(readNoiseElectrons) + " electrons; expected 0 to 1e6, and 0 to 1000");
  }
  const double s = readNoiseElectrons;
  const double least = s * s + 0.375;
  const double reach = 9.0 * std::sqrt(electrons) + 40.0;
  const double first = std::max(0.0, std::floor(electrons - reach));
  const double last = electrons > 0.0 ? std::ceil(electrons + reach) : 0.0;
  // Sums about the middle, so that the variance is not lost by cancellation.
  const double middle = std::sqrt(electrons + least);
  double       total = 0.0;
  double       root = 0.0;
  double       square = 0.0;
  double       negative = 0.0;
  for (double k = first; k <= last; ++k)
  {
    // The sign that lgamma stores for all threads is not used. NOLINTNEXTLINE(concurrency-mt-unsafe)
    const double logFactorial = std::lgamma(k + 1.0);
    const double probability = electrons > 0.0 ? std::exp(k * std::log(electrons) - electrons - logFactorial) : 1.0;
    const double meanRoot = MeanRoot(k + least, s);
    total += probability;
    root += probability * (meanRoot - middle);
    square += probability * (MeanArgument(k + least, s) - 2.0 * middle * meanRoot + middle * middle);
    negative += s == 0.0 ? 0.0 : probability * NormalDistribution(-(k + least) / s);
  }
  root /= total; // the rounding error of lgamma is common to all terms
  square /= total;
  return { 2.0 * (middle + root), 4.0 * (square - root * root), negative / total };
}

double
ExactUnbiasedInverse(double stabilisedMean, double readNoiseElectrons)
{
  const double s = readNoiseElectrons;
  if (!(stabilisedMean > MomentsOfStabilised(0.0, s).mean))
  {
    return 0.0;
  }
  // Newton's method from the asymptotic inverse. dD/dlambda is close to 1/sqrt(lambda + s^2 + 3/8), which suffices.
  double electrons = std::max(0.0, 0.25 * stabilisedMean * stabilisedMean - 0.125 - s * s);
  for (int i = 0; i < 60; ++i)
  {
    const double slope = 1.0 / std::sqrt(electrons + s * s + 0.375);
    const double step = (stabilisedMean - MomentsOfStabilised(electrons, s).mean) / slope;
    electrons = std::max(0.0, electrons + step);
    if (std::abs(step) < 1e-11 * (1.0 + electrons))
    {
      break;
    }
  }
  return electrons;
}

} // namespace sensornoise
