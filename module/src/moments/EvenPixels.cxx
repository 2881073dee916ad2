// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/EvenPixels.h"

#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackMaps.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

namespace
{
using Places = std::vector<std::size_t>;

/** Returns the mean of a cell over the frames with exposures from \a low to \a high [DN]. */
double
MeanBetween(const FrameThumbnails &     thumbnails,
            const Places &              counted,
            const std::vector<double> & exposures,
            double                      low,
            double                      high,
            std::size_t                 cell)
{
  double sum = 0.0;
  double frames = 0.0;
  for (const std::size_t t : counted)
  {
    if (exposures[t] >= low && exposures[t] <= high)
    {
      sum += thumbnails.MeanOf(t, cell);
      frames += 1.0;
    }
  }
  return sum / frames;
}

/** Levels of the finite cells [DN]. */
struct CellLevels
{
  Places              cells;         ///< numbers of the cells
  std::vector<double> means;         ///< means over all frames
  std::vector<double> atZero;        ///< levels at exposure 0, extrapolated from the lowest and the highest exposure
  double              zeroDn{ 0.0 }; ///< median of the levels at exposure 0
};

CellLevels
FindCellLevels(const FrameThumbnails & thumbnails, const Places & counted, const std::vector<double> & exposures)
{
  double low = exposures[counted.front()];
  double high = low;
  for (const std::size_t t : counted)
  {
    low = std::min(low, exposures[t]);
    high = std::max(high, exposures[t]);
  }
  CellLevels levels;
  for (std::size_t cell = 0; cell < thumbnails.NumberOfCells() && high > low; ++cell)
  {
    const double mean = MeanBetween(thumbnails, counted, exposures, low, high, cell);
    const double dim = MeanBetween(thumbnails, counted, exposures, low, low, cell);
    const double bright = MeanBetween(thumbnails, counted, exposures, high, high, cell);
    if (std::isfinite(mean))
    {
      levels.cells.push_back(cell);
      levels.means.push_back(mean);
      levels.atZero.push_back(dim - (bright - dim) * low / (high - low));
    }
  }
  levels.zeroDn = levels.atZero.empty() ? 0.0 : QuantileOf(levels.atZero, 0.5);
  return levels;
}
} // namespace

std::vector<std::uint8_t>
FindEvenPixels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures,
               const StackMaps &                maps)
{
  const CellLevels levels = counted.empty() ? CellLevels() : FindCellLevels(thumbnails, counted, exposures);
  if (levels.means.empty())
  {
    return maps.valid;
  }
  const double              brightest = QuantileOf(levels.means, InMoments.brightCellsQuantile) - levels.zeroDn;
  std::vector<std::uint8_t> even(maps.valid.size());
  for (double signal = InMoments.evenCellsRatio * brightest; signal > InMoments.leastReachOfCells * brightest;
       signal *= InMoments.evenCellsStep)
  {
    const double low = levels.zeroDn + signal / InMoments.evenCellsRatio;
    const double high = levels.zeroDn + signal * InMoments.evenCellsRatio;
    for (std::size_t p = 0; p < even.size(); ++p)
    {
      even[p] = maps.valid[p] != 0 && maps.mean[p] >= low && maps.mean[p] <= high ? 1 : 0;
    }
    const std::vector<bool> areEven = thumbnails.FindCellsWithin(even);
    const auto              count =
      std::count_if(levels.cells.begin(), levels.cells.end(), [&](std::size_t cell) { return areEven[cell]; });
    if (static_cast<std::size_t>(count) >= InMoments.fewestEvenCells)
    {
      return even;
    }
  }
  return maps.valid;
}

} // namespace sensornoise
