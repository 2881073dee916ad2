// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Stencils.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr int Width = 7;
constexpr int CentreX = 3;
constexpr int CentreY = 4;

/** Returns x^m y^n about the centre pixel, on 7 x 9 pixels. */
std::vector<double>
Monomial(int m, int n)
{
  std::vector<double> map;
  for (int y = 0; y < 9; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      map.push_back(std::pow(x - CentreX, m) * std::pow(y - CentreY, n));
    }
  }
  return map;
}

int
CountOf(const char * name, char letter)
{
  int count = 0;
  for (const char c : std::string(name))
  {
    count += c == letter ? 1 : 0;
  }
  return count;
}

double
Factorial(int n)
{
  return n < 2 ? 1.0 : n * Factorial(n - 1);
}

double
AtCentre(const Stencil & stencil, const std::vector<double> & map)
{
  return ApplyStencil(stencil, map.data(), Width, CentreY * Width + CentreX);
}
} // namespace

TEST(SensorNoiseStencils, TakeTheDerivativeThatTheyAreNamedAfter)
{
  // A central difference of order k is exact for polynomials up to the order k + 1: d^a/dx^a d^b/dy^b of x^m y^n at 0
  // is a! b! for m = a, n = b, and 0 otherwise.
  for (const Stencil & stencil : MotionStencils())
  {
    const int a = CountOf(stencil.name, 'x');
    const int b = CountOf(stencil.name, 'y');
    EXPECT_EQ(stencil.order, a + b) << stencil.name;
    for (int m = 0; m <= stencil.order + 1; ++m)
    {
      for (int n = 0; m + n <= stencil.order + 1; ++n)
      {
        const double expected = m == a && n == b ? Factorial(a) * Factorial(b) : 0.0;
        EXPECT_DOUBLE_EQ(AtCentre(stencil, Monomial(m, n)), expected) << stencil.name << " of " << m << ' ' << n;
      }
    }
  }
}

TEST(SensorNoiseStencils, IndicesNameTheStencils)
{
  const auto & stencils = MotionStencils();
  EXPECT_STREQ(stencils[StencilX].name, "x");
  EXPECT_STREQ(stencils[StencilY].name, "y");
  EXPECT_STREQ(stencils[StencilXX].name, "xx");
  EXPECT_STREQ(stencils[StencilYY].name, "yy");
  EXPECT_STREQ(stencils[StencilXY].name, "xy");
}

TEST(SensorNoiseStencils, ExchangedAxesGiveAnotherOfThem)
{
  for (const Stencil & stencil : MotionStencils())
  {
    const int    a = CountOf(stencil.name, 'x');
    const int    b = CountOf(stencil.name, 'y');
    const auto & stencils = MotionStencils();
    std::size_t  partners = 0;
    for (const Stencil & other : stencils)
    {
      if (CountOf(other.name, 'x') == b && CountOf(other.name, 'y') == a)
      {
        ++partners;
        // Any map will do: here an exponential and its transposed.
        std::vector<double> map(81);
        std::vector<double> transposed(81);
        for (std::size_t i = 0; i < 81; ++i)
        {
          map[i] = std::exp(0.3 * static_cast<double>(i % 9) - 0.2 * static_cast<double>(i / 9));
          transposed[i % 9 * 9 + i / 9] = map[i];
        }
        EXPECT_NEAR(
          ApplyStencil(stencil, map.data(), 9, 3 * 9 + 5), ApplyStencil(other, transposed.data(), 9, 5 * 9 + 3), 1e-14)
          << stencil.name;
      }
    }
    EXPECT_EQ(partners, 1u) << stencil.name;
  }
}

TEST(SensorNoiseStencils, AllAtOnceAreThoseOfEach)
{
  std::vector<double> map(81);
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    map[i] = static_cast<double>(i * i % 17);
  }
  const auto all = ApplyStencils(map.data(), 9, 3 * 9 + 5);
  for (std::size_t k = 0; k < NumberOfStencils; ++k)
  {
    EXPECT_EQ(all[k], ApplyStencil(MotionStencils()[k], map.data(), 9, 3 * 9 + 5)) << k;
  }
}

TEST(SensorNoiseStencils, KeepWithinTheMargin)
{
  for (const Stencil & stencil : MotionStencils())
  {
    for (const StencilTap & tap : stencil.taps)
    {
      EXPECT_LE(std::abs(tap.dx), static_cast<int>(StencilMargin)) << stencil.name;
      EXPECT_LE(std::abs(tap.dy), static_cast<int>(StencilMargin)) << stencil.name;
    }
  }
}

TEST(SensorNoiseStencils, InnerProductsAreExplicitSumsOfImpulseResponses)
{
  // A stencil at pixel p takes the weight of pixel q from a map that is 1 at q and 0 elsewhere.
  const auto &                     stencils = MotionStencils();
  std::vector<std::vector<double>> weights;
  for (const Stencil & stencil : stencils)
  {
    std::vector<double> own;
    for (std::size_t q = 0; q < Width * 9; ++q)
    {
      std::vector<double> impulse(Width * 9, 0.0);
      impulse[q] = 1.0;
      own.push_back(AtCentre(stencil, impulse));
    }
    EXPECT_EQ(stencil.CentreWeight(), own[CentreY * Width + CentreX]) << stencil.name;
    weights.push_back(own);
  }
  for (std::size_t i = 0; i < NumberOfStencils; ++i)
  {
    for (std::size_t j = 0; j < NumberOfStencils; ++j)
    {
      double sum = 0.0;
      for (std::size_t q = 0; q < Width * 9; ++q)
      {
        sum += weights[i][q] * weights[j][q];
      }
      EXPECT_DOUBLE_EQ(InnerProduct(stencils[i], stencils[j]), sum) << stencils[i].name << ' ' << stencils[j].name;
    }
  }
}
