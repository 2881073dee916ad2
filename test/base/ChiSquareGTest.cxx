// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace sensornoise;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Probabilities[] = { 1e-300, 1e-20, 1e-5, 0.01, 0.3, 0.5, 0.7, 0.99, 0.99999 };

void
ExpectRelative(double found, double expected, double tolerance, double parameter)
{
  EXPECT_NEAR(found, expected, tolerance * std::abs(expected)) << "at " << parameter;
}

/** Returns the upper tail of chi-square with an even number of degrees of freedom: the Poisson probability, mean x/2,
 * of fewer than dof/2 events. */
double
PoissonSum(double x, int dof)
{
  double term = std::exp(-0.5 * x);
  double sum = 0.0;
  for (int k = 0; k < dof / 2; ++k)
  {
    sum += term;
    term *= 0.5 * x / (k + 1);
  }
  return sum;
}
} // namespace

TEST(SensorNoiseChiSquare, TwoDegreesOfFreedomAreExponential)
{
  for (const double x : { 1e-12, 0.001, 0.5, 1.9, 2.1, 4.1, 30.0, 1300.0 })
  {
    ExpectRelative(ChiSquareUpper(x, 2.0), std::exp(-0.5 * x), 1e-12, x);
    ExpectRelative(ChiSquareCdf(x, 2.0), -std::expm1(-0.5 * x), 1e-12, x);
  }
  for (const double p : Probabilities)
  {
    ExpectRelative(ChiSquareQuantile(p, 2.0), -2.0 * std::log1p(-p), 1e-12, p);
    ExpectRelative(ChiSquareUpperQuantile(p, 2.0), -2.0 * std::log(p), 1e-12, p);
  }
}

TEST(SensorNoiseChiSquare, OneDegreeOfFreedomIsTheErrorFunction)
{
  for (const double x : { 1e-12, 0.001, 0.5, 1.4, 1.6, 3.1, 30.0, 1300.0 })
  {
    ExpectRelative(ChiSquareUpper(x, 1.0), std::erfc(std::sqrt(0.5 * x)), 1e-12, x);
    ExpectRelative(ChiSquareCdf(x, 1.0), std::erf(std::sqrt(0.5 * x)), 1e-12, x);
  }
}

TEST(SensorNoiseChiSquare, EvenDegreesOfFreedomArePoissonSums)
{
  for (const int dof : { 4, 10, 30, 32, 34, 100, 200 })
  {
    for (const double x : { 0.1, 1.0, 0.5 * dof, 0.9 * dof, dof - 0.1, dof + 2.1, 1.5 * dof, 4.0 * dof })
    {
      const double upper = PoissonSum(x, dof);
      ExpectRelative(ChiSquareUpper(x, dof), upper, 1e-11, x);
      EXPECT_NEAR(ChiSquareCdf(x, dof), 1.0 - upper, 1e-13) << x;
    }
  }
}

TEST(SensorNoiseChiSquare, SmallLowerTailKeepsItsDigits)
{
  // P(a, x) with its leading terms: x^a exp(-x) / Gamma(a + 1) (1 + x/(a+1) + ...), x = 1e-6.
  const double x = 2e-6;
  ExpectRelative(ChiSquareCdf(x, 4.0), 0.5e-12 * (1.0 - 2e-6 / 3.0), 1e-11, x);
  const double twentyFactorial = 2432902008176640000.0;
  ExpectRelative(ChiSquareCdf(x, 40.0), 1e-120 * (1.0 - 20e-6 / 21.0) / twentyFactorial, 1e-11, x);
}

TEST(SensorNoiseChiSquare, RecurrenceJoinsRealDegreesOfFreedom)
{
  // Q(a + 1, x) - Q(a, x) = x^a exp(-x) / Gamma(a + 1)
  for (const double dof : { 0.1, 0.7, 3.3, 29.3, 31.1, 47.9, 98.6 })
  {
    for (const double x : { 0.2 * dof, dof, dof + 2.5, 1.4 * dof })
    {
      const double a = 0.5 * dof;
      const double term = std::exp(a * std::log(0.5 * x) - 0.5 * x - std::log(std::tgamma(a + 1.0)));
      EXPECT_NEAR(ChiSquareUpper(x, dof + 2.0) - ChiSquareUpper(x, dof), term, 1e-13) << dof << ' ' << x;
    }
  }
}

TEST(SensorNoiseChiSquare, QuantilesUndoTheTails)
{
  for (const double dof : { 0.1, 0.3, 1.0, 2.5, 9.0, 31.0, 33.0, 98.7, 99.0, 499.0, 1e4, 1e6 })
  {
    for (const double p : Probabilities)
    {
      const double lower = ChiSquareQuantile(p, dof);
      if (lower > std::numeric_limits<double>::min())
      {
        ExpectRelative(ChiSquareCdf(lower, dof), p, 1e-10, dof);
      }
      ExpectRelative(ChiSquareUpper(ChiSquareUpperQuantile(p, dof), dof), p, 1e-10, dof);
    }
  }
}

TEST(SensorNoiseChiSquare, PublishedQuantiles)
{
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4: three decimals.
  EXPECT_NEAR(ChiSquareQuantile(0.95, 1.0), 3.841, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.95, 10.0), 18.307, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.99, 100.0), 135.807, 5e-4);
  EXPECT_NEAR(ChiSquareUpperQuantile(0.001, 30.0), 59.703, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.05, 30.0), 18.493, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.01, 100.0), 70.065, 5e-4);
}

TEST(SensorNoiseChiSquare, LargeDegreesOfFreedomAreNormal)
{
  // Cornish and Fisher: chi-square/dof = 1 + z sqrt(2/dof) + 2 (z^2 - 1) / (3 dof) + O(dof^-3/2)
  const double dof = 1e6;
  const double z = NormalQuantile(0.999);
  const double expected = 1.0 + z * std::sqrt(2.0 / dof) + 2.0 * (z * z - 1.0) / (3.0 * dof);
  EXPECT_NEAR(ChiSquareQuantile(0.999, dof) / dof, expected, 1e-8);
}

TEST(SensorNoiseChiSquare, Ends)
{
  EXPECT_EQ(ChiSquareCdf(0.0, 3.0), 0.0);
  EXPECT_EQ(ChiSquareCdf(-1.0, 3.0), 0.0);
  EXPECT_EQ(ChiSquareUpper(-1.0, 3.0), 1.0);
  EXPECT_EQ(ChiSquareCdf(Infinity, 3.0), 1.0);
  EXPECT_EQ(ChiSquareUpper(Infinity, 3.0), 0.0);
  EXPECT_TRUE(std::isnan(ChiSquareCdf(NotANumber, 3.0)));
  EXPECT_EQ(ChiSquareQuantile(0.0, 3.0), 0.0);
  EXPECT_EQ(ChiSquareQuantile(1.0, 3.0), Infinity);
  EXPECT_EQ(ChiSquareUpperQuantile(0.0, 3.0), Infinity);
  EXPECT_EQ(ChiSquareUpperQuantile(1.0, 3.0), 0.0);
  EXPECT_EQ(StudentQuantile(0.0, 3.0), -Infinity);
  EXPECT_EQ(StudentQuantile(1.0, 3.0), Infinity);
  EXPECT_EQ(StudentCdf(-Infinity, 3.0), 0.0);
  EXPECT_EQ(StudentCdf(Infinity, 3.0), 1.0);
  EXPECT_EQ(NormalQuantile(0.0), -Infinity);
  EXPECT_EQ(NormalQuantile(1.0), Infinity);
}

TEST(SensorNoiseChiSquare, RefusesWhatIsNoDistribution)
{
  EXPECT_THROW(ChiSquareCdf(1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(ChiSquareUpper(1.0, NotANumber), std::invalid_argument);
  EXPECT_THROW(ChiSquareQuantile(0.5, -1.0), std::invalid_argument);
  EXPECT_THROW(ChiSquareQuantile(1.5, 1.0), std::invalid_argument);
  EXPECT_THROW(ChiSquareUpperQuantile(NotANumber, 1.0), std::invalid_argument);
  EXPECT_THROW(StudentQuantile(0.5, Infinity), std::invalid_argument);
  EXPECT_THROW(NormalQuantile(-0.1), std::invalid_argument);
}

TEST(SensorNoiseChiSquare, StudentClosedForms)
{
  constexpr double pi = 3.14159265358979323846;
  for (const double p : { 1e-20, 1e-5, 0.01, 0.3, 0.45, 0.7, 0.975, 0.9999 })
  {
    const double q = 1.0 - p;
    const double cauchy = p < 0.25 ? -1.0 / std::tan(pi * p) : std::tan(pi * (p - 0.5));
    ExpectRelative(StudentQuantile(p, 1.0), cauchy, 1e-11, p);
    ExpectRelative(StudentQuantile(p, 2.0), (p - q) / std::sqrt(2.0 * p * q), 1e-11, p);
  }
  EXPECT_EQ(StudentQuantile(0.5, 7.0), 0.0);
  for (const double t : { -50.0, -1.7, -0.01, 0.01, 1.7, 50.0 })
  {
    // 1/2 + sin(a) (1 + cos(a)^2 / 2) / 2 with tan(a) = t / 2
    const double sine = t / std::sqrt(4.0 + t * t);
    EXPECT_NEAR(StudentCdf(t, 4.0), 0.5 + 0.5 * sine * (1.0 + 0.5 * (1.0 - sine * sine)), 1e-14) << t;
  }
}

TEST(SensorNoiseChiSquare, StudentRoundTripsAndPublishedQuantiles)
{
  for (const double dof : { 0.7, 1.0, 3.3, 31.0, 98.7, 1e4, 1e6 })
  {
    for (const double p : { 1e-100, 1e-20, 1e-5, 0.01, 0.3, 0.499, 0.7, 0.975, 0.99999 })
    {
      ExpectRelative(StudentCdf(StudentQuantile(p, dof), dof), p, 1e-10, dof);
    }
  }
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2: three decimals.
  EXPECT_NEAR(StudentQuantile(0.975, 5.0), 2.571, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.975, 10.0), 2.228, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.975, 30.0), 2.042, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.999, 100.0), 3.174, 5e-4);
}

TEST(SensorNoiseChiSquare, NormalQuantile)
{
  EXPECT_NEAR(NormalQuantile(0.975), 1.95996398454005423552, 1e-14);
  EXPECT_EQ(NormalQuantile(0.5), 0.0);
  for (const double p : Probabilities)
  {
    ExpectRelative(0.5 * std::erfc(NormalUpperQuantile(p) / std::sqrt(2.0)), p, 1e-12, p);
    EXPECT_EQ(NormalQuantile(p), -NormalUpperQuantile(p));
  }
}

TEST(SensorNoiseQuadrature, IsTheRootOfTheSquares)
{
  EXPECT_DOUBLE_EQ(AddInQuadrature(2.0, -3.0, 6.0), 7.0);
  EXPECT_EQ(AddInQuadrature(0.0, 0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(AddInQuadrature(2e200, 3e200, 6e200), 7e200);
}

TEST(SensorNoiseQuadrature, AnErrorThatIsNotKnownStaysSo)
{
  EXPECT_EQ(AddInQuadrature(Infinity, 1.0, 0.0), Infinity);
  EXPECT_EQ(AddInQuadrature(1.0, -Infinity, 0.0), Infinity);
  EXPECT_EQ(AddInQuadrature(1.0, 0.0, Infinity), Infinity);
  EXPECT_TRUE(std::isnan(AddInQuadrature(1.0, 0.0, NotANumber)));
}
