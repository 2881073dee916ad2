// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/CommonZero.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

double
Explained(const std::vector<TileLines> & tiles, double m)
{
  double sum = 0.0;
  for (const TileLines & s : tiles)
  {
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      sum += std::pow(s.r2[j] - m * s.r1[j], 2) / s.Precision(m);
    }
  }
  return sum;
}

namespace
{
/** Returns the derivative of Explained() by \a m. */
double
SlopeOfExplained(const std::vector<TileLines> & tiles, double m)
{
  double sum = 0.0;
  for (const TileLines & s : tiles)
  {
    const double precision = s.Precision(m);
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double slope = (s.r2[j] - m * s.r1[j]) / precision;
      sum += 2.0 * slope * (slope * (s.g12 - m * s.g11) - s.r1[j]);
    }
  }
  return sum;
}
} // namespace

double
FindCommonZero(const std::vector<TileLines> & tiles, double start, double range)
{
  double        best = start;
  double        highest = -1.0;
  constexpr int steps = 60;
  const double  step = 2.0 * range / steps;
  for (int i = 0; i <= steps; ++i)
  {
    const double m = start - 1.5 * range + i * step;
    const double value = Explained(tiles, m);
    if (value > highest)
    {
      highest = value;
      best = m;
    }
  }
  // The derivative is positive below the maximum. Its root is exact to the last bits, which the maximum is not.
  double low = best - step;
  double high = best + step;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (SlopeOfExplained(tiles, middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

ZeroErrors
SumErrors(const std::vector<TileLines> & tiles, double zero)
{
  ZeroErrors sums;
  for (const TileLines & s : tiles)
  {
    const double precision = s.Precision(zero);
    const double across = s.g12 - zero * s.g11;
    const double leverage = (s.g11 - across * across / precision) / precision;
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double r = s.r2[j] - zero * s.r1[j];
      const double signal = r * r / precision - 1.0; // square of the slope over its variance, without its noise
      sums.full +=
        (s.g22 * s.r1[j] * s.r1[j] - 2.0 * s.g12 * s.r1[j] * s.r2[j] + s.g11 * s.r2[j] * s.r2[j]) / s.Determinant();
      sums.information += signal * leverage;
      sums.scatter += (2.0 + 4.0 * std::max(0.0, signal)) * leverage * leverage; // noncentral chi-square
      sums.number += 1.0;
    }
  }
  return sums;
}

} // namespace sensornoise
