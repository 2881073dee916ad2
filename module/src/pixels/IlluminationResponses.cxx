// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/RegressionSums.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

bool
IsOffsetDrift(const IlluminationResponses & data)
{
  const std::size_t      side = InPattern.driftTileSide;
  const ReferenceFrame & frame = data.frame;
  const std::size_t      width = frame.geometry.width;
  const std::size_t      factors = data.factors;
  const std::size_t      across = (width + side - 1) / side;
  const std::size_t      count = across * ((frame.geometry.height + side - 1) / side);
  for (std::size_t j = 1; j < factors; ++j)
  {
    std::vector<RegressionSums> parts(count);
    RegressionSums              whole;
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        const double z = data.coordinates.At(p, j);
        const auto   own = RegressionSums::Of(w, centred, z);
        parts[p / width / side * across + p % width / side] += own;
        whole += own;
      }
    }
    const double determinant = whole.w * whole.xx - whole.x * whole.x;
    const double level = (whole.xx * whole.y - whole.x * whole.xy) / determinant;
    const double slope = (whole.w * whole.xy - whole.x * whole.y) / determinant;
    const double explained = level * whole.y + slope * whole.xy;
    double       chi2 = 0.0;
    double       used = 0.0;
    for (const RegressionSums & s : parts)
    {
      if (s.w > 0.0)
      {
        chi2 += std::pow(s.y - level * s.w - slope * s.x, 2) / s.w;
        used += 1.0;
      }
    }
    if (chi2 > InPattern.largestDriftChi2 * std::max(1.0, used - 2.0) ||
        explained < InPattern.leastDriftExplained * chi2)
    {
      return false;
    }
  }
  return factors > 1;
}

double
LocalFlicker::Sd(double offset) const
{
  const double flux = wII - 2.0 * offset * wI + offset * offset * w;
  return std::sqrt(std::max(0.0, energy / (flux * (frames - 1.0))));
}

LocalFlicker
SumLocalFlicker(const IlluminationResponses & data)
{
  const ReferenceFrame & frame = data.frame;
  const std::size_t      factors = data.factors;
  LocalFlicker           sums;
  sums.frames = static_cast<double>(frame.frames);
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double noise = data.line.At(frame.neighbourMean[p]);
      const double centred = frame.mean[p] - data.centreDn;
      for (std::size_t j = 0; j < factors; ++j)
      {
        sums.energy += std::pow(data.coordinates.At(p, j), 2) / noise - 1.0;
      }
      sums.w += 1.0 / noise;
      sums.wI += centred / noise;
      sums.wII += centred * centred / noise;
    }
  }
  return sums;
}

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
