// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise
{

// Incomplete gamma and beta functions, on which ChiSquare is based.
namespace
{
/** Least argument for which Stirling's series yields all digits. */
inline constexpr double StirlingLeast = 16.0;

/** Both tails of a distribution at one point. */
struct Tails
{
  double lower;
  double upper;
};

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

/** Returns x^a exp(-x) / Gamma(a + 1), for x > 0. For large a the huge factors are never computed. With x = a (1 + u)
 * their product is exp(-a (u - log(1 + u))) / sqrt(2 pi a), up to Stirling's remainder. */
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

/** Regularised incomplete gamma functions P(a, x) and Q(a, x): the series https://dlmf.nist.gov/8.11.E4 below the mean,
 * the continued fraction https://dlmf.nist.gov/8.9.E2 (contracted) above it. */
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

/** Returns t times the density of Student's t, for t > 0. */
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

/** Returns the probability that |t| is below (lower) and above (upper) a t > 0. These are the regularised incomplete
 * beta functions I_x(1/2, dof/2) and I_1-x(dof/2, 1/2) at x = t^2 / (dof + t^2), by https://dlmf.nist.gov/8.17.E22. */
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

void
RequireDof(double dof)
{
  if (!(dof > 0.0) || !std::isfinite(dof))
  {
    throw std::invalid_argument("the degrees of freedom are " + std::to_string(dof) +
                                "; expected a finite number above 0");
  }
}

void
CheckProbability(double probability)
{
  if (!(probability >= 0.0 && probability <= 1.0))
  {
    throw std::invalid_argument("the probability is " + std::to_string(probability) + "; expected 0 to 1");
  }
}

/** Returns the x at which a tail holds `probability` of the distribution of a positive number.
 *
 * Newton's method is applied to the logarithm of the tail as a function of log x. It is concave for chi-square and for
 * Student's |t|, so that the method converges from any start. The interval known to contain the solution guards
 * against overflow.
 * \param isUpper true: upper tail, false: lower tail
 * \param start first guess, above 0
 * \param tails returns both tails at x
 * \param slope returns x times the density at x */
template <typename TTails, typename TSlope>
double
SolveTail(double probability, bool isUpper, double start, TTails tails, TSlope slope)
{
  double low = -740.0;
  double high = 709.0;
  double logX = std::log(start);
  if (!(logX > low && logX < high))
  {
    logX = logX > 0.0 ? high - 1.0 : low + 1.0;
  }
  for (int i = 0; i < 200; ++i)
  {
    const double x = std::exp(logX);
    const Tails  both = tails(x);
    const double tail = isUpper ? both.upper : both.lower;
    ((tail < probability) == isUpper ? high : low) = logX;
    double next = logX - std::log(tail / probability) * tail / (isUpper ? -slope(x) : slope(x));
    if (!(next >= low && next <= high))
    {
      next = 0.5 * (low + high);
    }
    const double step = next - logX;
    logX = next;
    if (std::abs(step) <= 1e-14 * (1.0 + std::abs(logX)))
    {
      break;
    }
  }
  return std::exp(logX);
}

/** Returns the quantile of chi-square, from the smaller of its two tails. */
double
SolveChiSquare(double lower, double upper, double dof)
{
  RequireDof(dof);
  if (lower == 0.0 || upper == 0.0)
  {
    return lower == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const bool isUpper = upper < lower;
  // Start: Wilson and Hilferty, PNAS 17(12), 1931, DOI 10.1073/pnas.17.12.684: (chi-square/dof)^(1/3) is nearly normal.
  // Or the x at which the first term of the series equals the lower tail, which is to the left of the solution.
  const double a = 0.5 * dof;
  const double variance = 2.0 / (9.0 * dof);
  const double z = isUpper ? NormalUpperQuantile(upper) : NormalQuantile(lower);
  const double root = std::max(0.0, 1.0 - variance + z * std::sqrt(variance));
  const double least = a < StirlingLeast ? 2.0 * std::exp((std::log(lower) + std::log(std::tgamma(a + 1.0))) / a) : 0.0;
  const double start = std::max(dof * root * root * root, least);
  if (start < std::numeric_limits<double>::min() && a < StirlingLeast)
  {
    return start;
  }
  return SolveTail(
    isUpper ? upper : lower,
    isUpper,
    start,
    [a](double x) { return GammaTails(a, 0.5 * x); },
    [a](double x) { return a * GammaTerm(a, 0.5 * x); });
}

} // namespace

double
ChiSquareCdf(double x, double dof)
{
  RequireDof(dof);
  return GammaTails(0.5 * dof, 0.5 * x).lower;
}

double
ChiSquareUpper(double x, double dof)
{
  RequireDof(dof);
  return GammaTails(0.5 * dof, 0.5 * x).upper;
}

double
StudentCdf(double t, double dof)
{
  RequireDof(dof);
  if (t == 0.0 || std::isnan(t))
  {
    return t == 0.0 ? 0.5 : t;
  }
  const double half = 0.5 * (std::isinf(t) ? 0.0 : StudentTails(std::abs(t), dof).upper);
  return t < 0.0 ? half : 1.0 - half;
}

double
NormalUpperQuantile(double probability)
{
  CheckProbability(probability);
  if (probability > 0.5)
  {
    // 1 - probability is exact here.
    return -NormalUpperQuantile(1.0 - probability);
  }
  if (probability == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  // The tail is below exp(-z^2/2)/2 and its logarithm is concave: from here Newton's method descends to the solution.
  constexpr double sqrtHalf = 0.70710678118654752440;
  constexpr double inverseSqrtTwoPi = 0.39894228040143267794;
  double           z = std::sqrt(-2.0 * std::log(2.0 * probability));
  for (int i = 0; i < 100; ++i)
  {
    const double tail = 0.5 * std::erfc(z * sqrtHalf);
    const double step = std::log(tail / probability) * tail / (inverseSqrtTwoPi * std::exp(-0.5 * z * z));
    if (!std::isfinite(step))
    {
      break;
    }
    z += step;
    if (std::abs(step) <= 1e-14 * (1.0 + z))
    {
      break;
    }
  }
  return z;
}

double
NormalQuantile(double probability)
{
  return -NormalUpperQuantile(probability);
}

double
ChiSquareQuantile(double probability, double dof)
{
  CheckProbability(probability);
  return SolveChiSquare(probability, 1.0 - probability, dof);
}

double
ChiSquareUpperQuantile(double probability, double dof)
{
  CheckProbability(probability);
  return SolveChiSquare(1.0 - probability, probability, dof);
}

double
StudentQuantile(double probability, double dof)
{
  RequireDof(dof);
  CheckProbability(probability);
  const double upper = 2.0 * std::min(probability, 1.0 - probability);
  const double sign = probability < 0.5 ? -1.0 : 1.0;
  if (upper == 0.0 || upper == 1.0)
  {
    return upper == 0.0 ? sign * std::numeric_limits<double>::infinity() : 0.0;
  }
  const double lower = 1.0 - upper;
  const bool   isUpper = upper < lower;
  return sign * SolveTail(
                  isUpper ? upper : lower,
                  isUpper,
                  NormalUpperQuantile(0.5 * upper),
                  [dof](double t) { return StudentTails(t, dof); },
                  [dof](double t) { return 2.0 * StudentTerm(t, dof); });
}

} // namespace sensornoise
