// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"

#include "base/Significance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

CurveBin &
CurveBin::operator+=(const CurveBin & other)
{
  pixels += other.pixels;
  weight += other.weight;
  x += other.x;
  excess += other.excess;
  return *this;
}

CurveBin
VarianceCurve::SumOf(std::size_t first, std::size_t last) const
{
  CurveBin sum;
  for (std::size_t b = first; b < last; ++b)
  {
    sum += bins[b];
  }
  return sum;
}

double
VarianceCurve::ReducedChi2() const
{
  double chi2 = 0.0;
  double used = 0.0;
  for (const CurveBin & bin : bins)
  {
    if (bin.weight > 0.0)
    {
      chi2 += bin.excess * bin.excess / bin.weight;
      used += 1.0;
    }
  }
  return used > 2.0 ? chi2 / (used - 2.0) : 1.0;
}

double
VarianceCurve::Nonlinearity(double dispersion) const
{
  constexpr std::size_t groups = 16;
  double                largest = 0.0;
  for (std::size_t g = 0; g < groups; ++g)
  {
    const CurveBin group = this->SumOf(g * bins.size() / groups, (g + 1) * bins.size() / groups);
    if (group.weight > 0.0)
    {
      const double excess = group.excess / group.weight;
      const double square = excess * excess - Significance.oneTest * Significance.oneTest * dispersion / group.weight;
      largest = std::max(largest, std::sqrt(std::max(0.0, square)) / line.At(this->LevelOf(group)));
    }
  }
  return largest;
}

double
VarianceCurve::DarkestFraction(double blackDn) const
{
  if (bins.empty())
  {
    return 1.0;
  }
  const double brightest = this->LevelOf(bins.back()) - blackDn;
  return brightest > 0.0 ? std::clamp((this->LevelOf(bins.front()) - blackDn) / brightest, 0.0, 1.0) : 1.0;
}

VarianceCurve::Slope
VarianceCurve::SlopeOf(std::size_t first, std::size_t last) const
{
  // Only differences between bins are used: within a bin, levels also differ by fixed-pattern noise.
  const CurveBin all = this->SumOf(first, last);
  const double   centre = all.weight > 0.0 ? all.x / all.weight : 0.0;
  double         information = 0.0;
  double         product = 0.0;
  for (std::size_t b = first; b < last; ++b)
  {
    const double x = bins[b].x / bins[b].weight - centre;
    information += bins[b].weight * x * x;
    product += bins[b].excess * x;
  }
  return { information, all.weight, information > 0.0 ? product / information : 0.0 };
}

std::vector<SlopeExcess>
VarianceCurve::FitHalves() const
{
  const CurveBin all = this->SumOf(0, bins.size());
  const Slope    whole = this->SlopeOf(0, bins.size());
  double         pixels = 0.0;
  double         information = 0.0;
  std::size_t    byCount = 0;
  std::size_t    byInformation = 0;
  for (const CurveBin & bin : bins)
  {
    const double x = bin.x / bin.weight - all.x / all.weight;
    pixels += bin.pixels;
    information += bin.weight * x * x;
    byCount += pixels <= 0.5 * all.pixels ? 1 : 0;
    byInformation += information <= 0.5 * whole.information ? 1 : 0;
  }
  std::vector<SlopeExcess> slopes;
  for (const std::size_t middle : { byCount, byInformation })
  {
    for (const Slope & half : { this->SlopeOf(0, middle), this->SlopeOf(middle, bins.size()) })
    {
      if (half.information > 1e-9 * whole.information)
      {
        slopes.push_back({ half.excess,
                           std::max(0.0, 1.0 / half.information - 1.0 / whole.information),
                           half.information / half.weight });
      }
    }
  }
  return slopes;
}

} // namespace sensornoise
