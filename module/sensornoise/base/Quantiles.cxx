// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

double
Quantile(std::vector<double> & values, double q)
{
  if (values.empty())
  {
    throw std::invalid_argument("a quantile of no value was asked for");
  }
  const double position = q * static_cast<double>(values.size() - 1);
  const auto   below = static_cast<std::size_t>(position);
  const auto   nth = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), nth, values.end());
  if (below + 1 == values.size())
  {
    return *nth;
  }
  const double lower = *nth;
  const double upper = *std::min_element(nth + 1, values.end());
  return lower + (position - static_cast<double>(below)) * (upper - lower);
}

double
QuantileOf(std::vector<double> values, double q)
{
  return Quantile(values, q);
}

std::vector<std::size_t>
SamplePixels(const std::uint8_t * mask, std::size_t pixels, std::size_t most)
{
  const std::size_t count = pixels - static_cast<std::size_t>(std::count(mask, mask + pixels, std::uint8_t{ 0 }));
  const std::size_t stride = std::max<std::size_t>(1, count / most);
  std::vector<std::size_t> sample;
  std::size_t              skip = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    if (mask[p] != 0 && skip-- == 0)
    {
      sample.push_back(p);
      skip = stride - 1;
    }
  }
  return sample;
}

std::vector<double>
MediansOfBins(const std::vector<double> & values, const std::vector<std::size_t> & binOf, std::size_t bins)
{
  std::vector<std::vector<double>> valuesOf(bins);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    valuesOf[binOf[i]].push_back(values[i]);
  }
  std::vector<double> medians(bins);
  for (std::size_t b = 0; b < bins; ++b)
  {
    medians[b] = valuesOf[b].empty() ? std::nan("") : Quantile(valuesOf[b], 0.5);
  }
  return medians;
}

std::vector<double>
EdgesOfEqualCount(std::vector<double> values, std::size_t bins)
{
  std::sort(values.begin(), values.end());
  std::vector<double> edges;
  for (std::size_t b = 1; b < bins && !values.empty(); ++b)
  {
    edges.push_back(values[b * values.size() / bins] - 1e-9 * (values.back() - values.front()));
  }
  return edges;
}

std::vector<std::size_t>
BinsOfEqualCount(const std::vector<double> & values, std::size_t bins)
{
  const std::vector<double> edges = EdgesOfEqualCount(values, bins);
  std::vector<std::size_t>  binOf(values.size());
  std::transform(values.begin(), values.end(), binOf.begin(), [&edges](double value) { return BinOf(edges, value); });
  return binOf;
}

} // namespace sensornoise
