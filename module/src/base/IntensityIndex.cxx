// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/IntensityIndex.h"

#include "base/ValueRange.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sensornoise
{

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
