// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

namespace
{
/** Number of bytes of a mask that are counted at once. */
constexpr std::size_t Group = sizeof(std::uint64_t);

/** Returns the number of bytes of a group that are not zero. */
std::size_t
CountGroup(const std::uint8_t * mask)
{
  constexpr std::uint64_t ones = 0x0101010101010101U;
  std::uint64_t           bytes = 0;
  std::memcpy(&bytes, mask, Group);
  for (const int shift : { 4, 2, 1 })
  {
    bytes |= bytes >> shift; // the lowest bit of a byte becomes 1 if any of its bits is
  }
  return static_cast<std::size_t>(((bytes & ones) * ones) >> 56U); // their sum is the highest byte of the product
}
} // namespace

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

RobustCentre
CentreOf(std::vector<double> values)
{
  RobustCentre centre;
  centre.median = Quantile(values, 0.5);
  for (double & value : values)
  {
    value = std::abs(value - centre.median);
  }
  centre.sd = Quantile(values, 0.5) / MedianOfNormal;
  return centre;
}

std::size_t
FindDensestHalf(const std::vector<double> & sorted)
{
  const std::size_t half = (sorted.size() + 1) / 2;
  std::size_t       begin = 0;
  for (std::size_t i = 1; i + half <= sorted.size(); ++i)
  {
    const auto length = [&](std::size_t first) { return sorted[first + half - 1] - sorted[first]; };
    begin = length(i) < length(begin) ? i : begin;
  }
  return begin;
}

double
SortedQuantile(const std::vector<double> & sorted, double q)
{
  if (sorted.empty())
  {
    throw std::invalid_argument("a quantile of no value was asked for");
  }
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto   below = static_cast<std::size_t>(position);
  const double lower = sorted[below];
  const double upper = sorted[std::min(below + 1, sorted.size() - 1)];
  return lower + (position - static_cast<double>(below)) * (upper - lower);
}

std::vector<std::size_t>
SamplePixels(const std::uint8_t * mask, std::size_t pixels, std::size_t most)
{
  const std::size_t count = pixels - static_cast<std::size_t>(std::count(mask, mask + pixels, std::uint8_t{ 0 }));
  const std::size_t stride = std::max<std::size_t>(1, count / most);
  std::vector<std::size_t> sample;
  sample.reserve((count + stride - 1) / stride);
  std::size_t skip = 0; // number of pixels of the mask before the next one
  for (std::size_t p = 0; p < pixels;)
  {
    const std::size_t ofGroup = p + Group <= pixels ? CountGroup(mask + p) : Group;
    if (ofGroup <= skip)
    {
      skip -= ofGroup;
      p += Group;
      continue;
    }
    for (const std::size_t last = std::min(p + Group, pixels); p < last; ++p)
    {
      if (mask[p] != 0 && skip-- == 0)
      {
        sample.push_back(p);
        skip = stride - 1;
      }
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
  if (values.empty() || bins < 2)
  {
    return {};
  }
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double        below = 1e-9 * (*largest - *least);
  std::vector<double> edges(bins - 1);
  // Values are sorted only as far as their bins: the middle edge separates them, and so on in both halves.
  const auto part = [&](std::size_t firstBin, std::size_t lastBin, const auto & again) -> void {
    if (lastBin - firstBin > 1)
    {
      const auto at = [&](std::size_t bin) { return values.begin() + std::ptrdiff_t(bin * values.size() / bins); };
      const std::size_t middle = (firstBin + lastBin) / 2;
      if (at(middle) < at(lastBin))
      {
        std::nth_element(at(firstBin), at(middle), at(lastBin));
      }
      edges[middle - 1] = *at(middle) - below;
      again(firstBin, middle, again);
      again(middle, lastBin, again);
    }
  };
  part(0, bins, part);
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
