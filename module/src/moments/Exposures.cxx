// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/Exposures.h"

#include "base/Quantiles.h"
#include "base/Text.h"
#include "moments/Constants.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackMaps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
using FramesByExposure = std::map<double, std::vector<std::size_t>>;

/** Returns the \a counted frames by their exposure. */
FramesByExposure
GroupByExposure(const std::vector<std::size_t> & counted, const std::vector<double> & exposures)
{
  FramesByExposure frames;
  for (const std::size_t t : counted)
  {
    frames[exposures[t]].push_back(t);
  }
  return frames;
}

/** Returns the mean of a cell over some frames [DN]. */
double
CellMean(const FrameThumbnails & thumbnails, const std::vector<std::size_t> & frames, std::size_t cell)
{
  double sum = 0.0;
  for (const std::size_t t : frames)
  {
    sum += thumbnails.MeanOf(t, cell);
  }
  return sum / static_cast<double>(frames.size());
}

/** A cell and its signal: the rise of its mean from the lowest to the highest exposure [DN]. */
struct CellSignal
{
  std::size_t cell;
  double      signalDn;
};

double
BrightSignal(const std::vector<CellSignal> & cells)
{
  std::vector<double> signals;
  std::transform(
    cells.begin(), cells.end(), std::back_inserter(signals), [](const CellSignal & each) { return each.signalDn; });
  return signals.empty() ? 0.0 : Quantile(signals, InMoments.brightCellsQuantile);
}

/** Finds the cells whose levels are used, see FindExposureLevels(). */
std::vector<std::size_t>
FindBrightCells(const FrameThumbnails &           thumbnails,
                const FramesByExposure &          frames,
                const std::vector<std::uint8_t> & valid)
{
  const std::vector<bool> areWhole = thumbnails.FindCellsWithin(valid);
  std::vector<CellSignal> all;
  std::vector<CellSignal> whole;
  for (std::size_t cell = 0; cell < thumbnails.NumberOfCells(); ++cell)
  {
    const bool isFinite = std::all_of(frames.begin(), frames.end(), [&](const auto & each) {
      return std::isfinite(CellMean(thumbnails, each.second, cell));
    });
    if (isFinite)
    {
      all.push_back(
        { cell,
          CellMean(thumbnails, frames.rbegin()->second, cell) - CellMean(thumbnails, frames.begin()->second, cell) });
      if (areWhole[cell])
      {
        whole.push_back(all.back());
      }
    }
  }
  const bool canUseWhole =
    whole.size() >= InMoments.fewestEvenCells && BrightSignal(whole) >= InMoments.leastReachOfCells * BrightSignal(all);
  const std::vector<CellSignal> & candidates = canUseWhole ? whole : all;
  const double                    least = InMoments.brightCellsFraction * BrightSignal(candidates);
  std::vector<std::size_t>        cells;
  for (const CellSignal & each : candidates)
  {
    if (each.signalDn >= least)
    {
      cells.push_back(each.cell);
    }
  }
  return cells;
}

/** Returns the variance of the mean of one frame due to the noise of its pixels, from the differences between the
 * motions of the cells [DN^2]. */
double
PixelNoise(const std::vector<std::vector<double>> & deviations)
{
  double squares = 0.0;
  for (const std::vector<double> & frame : deviations)
  {
    double common = 0.0;
    for (const double own : frame)
    {
      common += own / static_cast<double>(frame.size());
    }
    for (const double own : frame)
    {
      squares += (own - common) * (own - common);
    }
  }
  const auto cells = static_cast<double>(deviations.front().size());
  return squares / (cells * (cells - 1.0) * (static_cast<double>(deviations.size()) - 1.0));
}

ExposureLevel
MakeLevel(const FrameThumbnails &          thumbnails,
          const std::vector<std::size_t> & cells,
          double                           exposure,
          const std::vector<std::size_t> & frames)
{
  ExposureLevel       level;
  const auto          count = static_cast<double>(cells.size());
  std::vector<double> means;
  for (const std::size_t cell : cells)
  {
    means.push_back(CellMean(thumbnails, frames, cell));
    level.meanDn += means.back() / count;
  }
  level.exposure = exposure;
  level.frames = frames.size();
  std::vector<std::vector<double>> deviations;
  double                           upperBound = 0.0;
  for (const std::size_t t : frames)
  {
    std::vector<double> frame = thumbnails.MeansOf(t, cells);
    double              mean = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      mean += frame[i] / count;
      frame[i] -= means[i];
    }
    level.squaresDn2 += (mean - level.meanDn) * (mean - level.meanDn);
    deviations.push_back(std::move(frame));
    upperBound += thumbnails.NoiseOf(t) / (count * static_cast<double>(frames.size()));
  }
  level.pixelNoiseDn2 = frames.size() > 1 ? PixelNoise(deviations) : upperBound;
  for (const double mean : means)
  {
    level.patternDn2 += (mean - level.meanDn) * (mean - level.meanDn) / (count * (count - 1.0));
  }
  return level;
}
} // namespace

void
ValidateExposures(const std::vector<double> & exposures)
{
  for (std::size_t t = 0; t < exposures.size(); ++t)
  {
    if (!(std::isfinite(exposures[t]) && exposures[t] >= 0.0))
    {
      throw std::invalid_argument("the exposure of frame " + std::to_string(t) + " is " + Text(exposures[t]) +
                                  "; expected a finite number, 0 (a dark frame) or more");
    }
  }
  const std::set<double> different(exposures.begin(), exposures.end());
  if (!exposures.empty() && different.size() < InCommon.fewestLevels)
  {
    throw std::invalid_argument("the exposures have " + std::to_string(different.size()) +
                                (different.size() == 1 ? " value" : " different values") +
                                "; expected at least 3, as a line passes through any two levels: leave the exposures "
                                "out, or add frames of other exposures");
  }
}

void
RequireExposuresOfFrames(const std::vector<double> & exposures, std::size_t frames)
{
  if (!exposures.empty() && exposures.size() != frames)
  {
    throw std::invalid_argument("there are " + std::to_string(exposures.size()) + " exposures, but " +
                                std::to_string(frames) +
                                " frames; expected one exposure for each frame, in the order of the frames");
  }
}

std::vector<ExposureLevel>
FindExposureLevels(const FrameThumbnails &           thumbnails,
                   const std::vector<std::size_t> &  counted,
                   const std::vector<double> &       exposures,
                   const std::vector<std::uint8_t> & valid)
{
  const FramesByExposure     frames = GroupByExposure(counted, exposures);
  std::vector<ExposureLevel> levels;
  if (frames.empty())
  {
    return levels;
  }
  const std::vector<std::size_t> cells = FindBrightCells(thumbnails, frames, valid);
  if (cells.size() < 2)
  {
    return levels;
  }
  for (const auto & [exposure, ofExposure] : frames)
  {
    levels.push_back(MakeLevel(thumbnails, cells, exposure, ofExposure));
  }
  return levels;
}

namespace
{
/** Levels of the finite cells [DN]. */
struct CellLevels
{
  std::vector<std::size_t> cells;  ///< numbers of the cells
  std::vector<double>      means;  ///< means over all frames
  std::vector<double>      atZero; ///< levels at exposure 0, extrapolated from the lowest and the highest exposure
  double                   zeroDn{ 0.0 }; ///< median of the levels at exposure 0
};

CellLevels
FindCellLevels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures)
{
  const FramesByExposure frames = GroupByExposure(counted, exposures);
  const auto & [low, dimmest] = *frames.begin();
  const auto & [high, brightest] = *frames.rbegin();
  CellLevels levels;
  for (std::size_t cell = 0; cell < thumbnails.NumberOfCells() && high > low; ++cell)
  {
    const double mean = CellMean(thumbnails, counted, cell);
    const double dim = CellMean(thumbnails, dimmest, cell);
    const double bright = CellMean(thumbnails, brightest, cell);
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
