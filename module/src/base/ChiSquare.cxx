// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"

#include "base/DistributionTails.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{

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
 * \param isUpper which tail
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
