// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/Random.h"

#include "base/BytesFingerprint.h"

#include <cmath>
#include <initializer_list>

namespace sensornoise
{
CounterSeededRandom::CounterSeededRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  // Each step is one to one in its counter, so that no two rows of one frame have the same generator.
  std::uint64_t hash = MixBits(seed + golden);
  for (const std::uint64_t counter : { stream, a, b })
  {
    hash = MixBits((hash ^ counter) + golden);
  }
  for (std::uint64_t & word : m_State)
  {
    hash += golden;
    word = MixBits(hash);
  }
}

std::int64_t
CounterSeededRandom::Poisson(double mean)
{
  if (!(mean > 0.0))
  {
    return 0;
  }
  return mean < 10.0 ? PoissonByMultiplication(mean) : PoissonByTransformedRejection(mean);
}

double
CounterSeededRandom::LogFactorial(double k)
{
  constexpr double factorials[] = { 1.0,         1.0,          2.0,           6.0,
                                    24.0,        120.0,        720.0,         5040.0,
                                    40320.0,     362880.0,     3628800.0,     39916800.0,
                                    479001600.0, 6227020800.0, 87178291200.0, 1307674368000.0 };
  if (k < 16.0)
  {
    return std::log(factorials[static_cast<int>(k)]);
  }
  constexpr double halfLogTwoPi = 0.91893853320467274178;
  const double     inverse = 1.0 / k;
  const double     inverseSquared = inverse * inverse;
  return (k + 0.5) * std::log(k) - k + halfLogTwoPi +
         inverse * (1.0 / 12.0 - inverseSquared * (1.0 / 360.0 - inverseSquared / 1260.0));
}

std::int64_t
CounterSeededRandom::PoissonByMultiplication(double mean)
{
  const double limit = std::exp(-mean);
  std::int64_t count = 0;
  for (double product = Uniform(); product > limit; product *= Uniform())
  {
    ++count;
  }
  return count;
}

std::int64_t
CounterSeededRandom::PoissonByTransformedRejection(double mean)
{
  // Names and constants of PTRS: a and b shape the hat function, its immediate acceptance area has height vr.
  const double b = 0.931 + 2.53 * std::sqrt(mean);
  const double a = -0.059 + 0.02483 * b;
  const double vr = 0.9277 - 3.6224 / (b - 2.0);
  while (true)
  {
    const double u = Uniform() - 0.5;
    const double v = Uniform();
    const double us = 0.5 - std::abs(u);
    const double k = std::floor((2.0 * a / us + b) * u + mean + 0.43);
    if (us >= 0.07 && v <= vr)
    {
      return static_cast<std::int64_t>(k);
    }
    if (k < 0.0 || (us < 0.013 && v > us))
    {
      continue;
    }
    const double inverseAlpha = 1.1239 + 1.1328 / (b - 3.4);
    if (std::log(v * inverseAlpha / (a / (us * us) + b)) <= k * std::log(mean) - mean - LogFactorial(k))
    {
      return static_cast<std::int64_t>(k);
    }
  }
}

} // namespace sensornoise
