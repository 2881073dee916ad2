// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
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

IntensityIndex::IntensityIndex(const double *       mean,
                               const std::uint8_t * mask,
                               std::size_t          pixels,
                               const ParallelFor &  parallelFor)
  : m_Mean(mean)
  , m_Mask(mask)
  , m_Pixels(pixels)
  , m_Cumulative(Cells + 1, 0)
{
  const ValueRange range = RangeOverPixels(
    pixels, parallelFor, [mask](std::size_t p) { return mask[p] != 0; }, [mean](std::size_t p) { return mean[p]; });
  m_Lowest = range.lowest;
  m_CellsPerDn = range.highest > range.lowest ? static_cast<double>(Cells) / (range.highest - range.lowest) : 0.0;
  constexpr std::size_t fewest = std::size_t{ 1 } << 17; // least number of pixels for which a
                                                         // separate histogram saves time
  const std::size_t                       parts = std::clamp<std::size_t>(pixels / fewest, 1, 8);
  std::vector<std::vector<std::uint32_t>> counts(parts);
  parallelFor(parts, [&](std::size_t part) {
    std::vector<std::uint32_t> own(Cells, 0);
    for (std::size_t p = part * pixels / parts; p < (part + 1) * pixels / parts; ++p)
    {
      if (mask[p] != 0)
      {
        ++own[this->CellOf(mean[p])];
      }
    }
    counts[part] = std::move(own);
  });
  for (std::size_t cell = 0; cell < Cells; ++cell)
  {
    m_Cumulative[cell + 1] = m_Cumulative[cell];
    for (const std::vector<std::uint32_t> & part : counts)
    {
      m_Cumulative[cell + 1] += part[cell];
    }
  }
}

IntensityIndex::Bins::Bins(const IntensityIndex & index, std::size_t bins)
  : m_Index(index)
  , m_OfCell(Cells)
{
  const std::size_t count = std::max<std::size_t>(1, index.Count());
  for (std::size_t cell = 0; cell < Cells; ++cell)
  {
    const std::size_t middle = (index.m_Cumulative[cell] + index.m_Cumulative[cell + 1]) / 2;
    m_OfCell[cell] = static_cast<std::uint16_t>(std::min(bins - 1, middle * bins / count));
  }
}

double
IntensityIndex::QuantileDn(double q, const ParallelFor & parallelFor) const
{
  if (this->Count() == 0)
  {
    throw std::invalid_argument("a quantile of no pixel was asked for");
  }
  const double        position = q * static_cast<double>(this->Count() - 1);
  const auto          below = static_cast<std::size_t>(position);
  const std::size_t   first = this->CellOfRank(below);
  const std::size_t   last = this->CellOfRank(std::min(below + 1, this->Count() - 1));
  std::vector<double> values;
  for (const std::vector<double> &part :
       PartsOfBlocks<std::vector<double>>(m_Pixels, parallelFor, [&](std::size_t begin, std::size_t end, auto & own) {
         for (std::size_t p = begin; p < end; ++p)
         {
           if (m_Mask[p] != 0 && this->CellOf(m_Mean[p]) >= first && this->CellOf(m_Mean[p]) <= last)
           {
             own.push_back(m_Mean[p]);
           }
         }
       }))
  {
    values.insert(values.end(), part.begin(), part.end());
  }
  std::sort(values.begin(), values.end());
  const std::size_t rank = below - m_Cumulative[first];
  const double      lower = values[rank];
  const double      upper = values[std::min(rank + 1, values.size() - 1)];
  return lower + (position - static_cast<double>(below)) * (upper - lower);
}

double
IntensityIndex::ReachDn(double levelDn, std::size_t count) const
{
  count = std::min(count, this->Count());
  const std::size_t centre = this->CellOf(levelDn);
  std::size_t       margin = 1;
  while (this->CountBetween(centre, margin) < count)
  {
    margin *= 2;
  }
  // The pixels of a cell may all be at its far side; one more cell, because the edges of cells are rounded.
  const double        limit = m_CellsPerDn > 0.0 ? static_cast<double>(margin + 2) / m_CellsPerDn : 1.0;
  std::vector<double> distances;
  for (std::size_t p = 0; p < m_Pixels; ++p)
  {
    const double distance = m_Mask[p] != 0 ? std::abs(m_Mean[p] - levelDn) : -1.0;
    if (distance >= 0.0 && distance <= limit)
    {
      distances.push_back(distance);
    }
  }
  const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(distances.begin(), nth, distances.end());
  return *nth;
}

std::size_t
IntensityIndex::CellOfRank(std::size_t rank) const
{
  const auto next = std::upper_bound(m_Cumulative.begin(), m_Cumulative.end(), rank);
  return static_cast<std::size_t>(next - m_Cumulative.begin()) - 1;
}

std::size_t
IntensityIndex::CountBetween(std::size_t centre, std::size_t margin) const
{
  const std::size_t first = centre > margin ? centre - margin : 0;
  const std::size_t last = std::min(Cells, centre + margin + 1);
  return m_Cumulative[last] - m_Cumulative[first];
}

} // namespace sensornoise
