// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/DistributionTails.h"

#include <cmath>

namespace sensornoise
{

namespace
{

/** Returns log Gamma(z) - ((z - 1/2) log z - z + log sqrt(2 pi)), for z >= StirlingLeast
 * (https://dlmf.nist.gov/5.11.E1). */
double
StirlingRemainder(double z)
{
  const double inverse = 1.0 / z;
  const double w = inverse * inverse;
  return inverse * (1.0 / 12.0 - w * (1.0 / 360.0 - w * (1.0 / 1260.0 - w * (1.0 / 1680.0 - w / 1188.0))));
}

/** Returns b0 + a1 / (b1 + a2 / (b2 + ...)), from the products of ratios of successive convergents (modified Lentz;
 * Thompson and Barnett, J. Comput. Phys. 64, 1986, DOI 10.1016/0021-9991(86)90046-X). `numerator(n)` is a_n and
 * `denominator(n)` is b_n. */
template <typename TNumerator, typename TDenominator>
double
ContinuedFraction(TNumerator numerator, TDenominator denominator)
{
  constexpr double precision = 1e-16;
  constexpr int    mostTerms = 10000000;
  const auto       notZero = [](double value) { return value == 0.0 ? 1e-300 : value; };
  double           value = notZero(denominator(0));
  double           upper = value;
  double           lower = 0.0;
  for (int n = 1; n < mostTerms; ++n)
  {
    lower = 1.0 / notZero(denominator(n) + numerator(n) * lower);
    upper = notZero(denominator(n) + numerator(n) / upper);
    value *= upper * lower;
    if (std::abs(upper * lower - 1.0) <= precision)
    {
      break;
    }
  }
  return value;
}

} // namespace

double
GammaTerm(double a, double x)
{
  constexpr double twoPi = 6.283185307179586476925;
  if (a < StirlingLeast)
  {
    return std::exp(a * std::log(x) - x) / std::tgamma(a + 1.0);
  }
  const double u = (x - a) / a;
  const double logarithm = std::abs(u) < 0.5 ? std::log1p(u) : std::log(x / a);
  return std::exp(-a * (u - logarithm) - StirlingRemainder(a)) / std::sqrt(twoPi * a);
}

Tails
GammaTails(double a, double x)
{
  if (!(x > 0.0))
  {
    return { x <= 0.0 ? 0.0 : x, x <= 0.0 ? 1.0 : x };
  }
  if (std::isinf(x))
  {
    return { 1.0, 0.0 };
  }
  const double term = GammaTerm(a, x);
  if (x < a + 1.0)
  {
    double sum = 1.0;
    double summand = 1.0;
    for (double n = 1.0; summand > 1e-17 * sum; n += 1.0)
    {
      summand *= x / (a + n);
      sum += summand;
    }
    return { term * sum, 1.0 - term * sum };
  }
  const double fraction =
    ContinuedFraction([a](int n) { return -n * (n - a); }, [a, x](int n) { return x - a + (2.0 * n + 1.0); });
  const double upper = a * term / fraction;
  return { 1.0 - upper, upper };
}

double
StudentTerm(double t, double dof)
{
  constexpr double sqrtPi = 1.7724538509055160273;
  constexpr double huge = 1e10;
  const double     a = 0.5 * dof;
  // Gamma(a + 1/2) / Gamma(a)
  const double ratio =
    a < StirlingLeast
      ? std::tgamma(a + 0.5) / std::tgamma(a)
      : std::sqrt(a) * std::exp(a * std::log1p(0.5 / a) - 0.5 + StirlingRemainder(a + 0.5) - StirlingRemainder(a));
  const double w = t / std::sqrt(dof);
  const double logW = std::log(w);
  return ratio / sqrtPi * std::exp(logW - (a + 0.5) * (w < huge ? std::log1p(w * w) : 2.0 * logW));
}

Tails
StudentTails(double t, double dof)
{
  const double front = StudentTerm(t, dof);
  const auto   beta = [front](double x, double a, double b) {
    const auto numerator = [x, a, b](int n) {
      const double m = n / 2;
      return n % 2 == 0 ? m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
                          : -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    };
    return front / a / ContinuedFraction(numerator, [](int) { return 1.0; });
  };
  const double x = 1.0 / (1.0 + dof / t / t);
  if (x * (dof + 5.0) < 3.0)
  {
    const double lower = beta(x, 0.5, 0.5 * dof);
    return { lower, 1.0 - lower };
  }
  const double upper = beta(1.0 / (1.0 + t * (t / dof)), 0.5 * dof, 0.5);
  return { 1.0 - upper, upper };
}

} // namespace sensornoise
