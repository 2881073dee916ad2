// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/UnlikeFrames.h"

#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "moments/FrameFit.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackFrames.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

namespace sensornoise
{

namespace
{
using Indices = std::vector<std::size_t>;

/** Returns the cells, of \a cells, that have finite pixels in all of the frames \a kept. */
Indices
FiniteCells(const FrameThumbnails & thumbnails, const Indices & cells, const Indices & kept)
{
  Indices finite;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(finite), [&](std::size_t cell) {
    return std::all_of(
      kept.begin(), kept.end(), [&](std::size_t t) { return std::isfinite(thumbnails.MeanOf(t, cell)); });
  });
  return finite;
}

/** Returns the cells that have finite pixels in more than half of the frames. */
Indices
FindUsableCells(const FrameThumbnails & thumbnails)
{
  Indices cells;
  for (std::size_t cell = 0; cell < thumbnails.NumberOfCells(); ++cell)
  {
    std::size_t finite = 0;
    for (std::size_t t = 0; t < thumbnails.NumberOfFrames(); ++t)
    {
      finite += std::isfinite(thumbnails.MeanOf(t, cell)) ? 1 : 0;
    }
    if (2 * finite > thumbnails.NumberOfFrames())
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

using Faults = std::map<std::size_t, FrameFault>; // reasons by the numbers of the frames that are left out

bool
IsEmpty(FrameFault fault)
{
  return fault == FrameFault::NotFinite || fault == FrameFault::NoNoise;
}

/** Returns whether so few of the frames are left out that the others are the burst. Empty frames are not part of a
 * burst, however many they are. Of the other frames at most the fraction \a share may be left out [1]. */
bool
AreFew(const Faults & faults, std::size_t frames, double share)
{
  const auto empty = static_cast<std::size_t>(
    std::count_if(faults.begin(), faults.end(), [](const auto & fault) { return IsEmpty(fault.second); }));
  const auto full = static_cast<double>(frames - std::min(frames, empty));
  return static_cast<double>(faults.size() - empty) <= share * full && faults.size() + MinimumFrames <= frames;
}

/** Returns the frames in ascending order; an empty list if they are too many of \a frames. */
std::vector<LeftOutFrame>
AsList(const Faults & faults, std::size_t frames, double share = InMoments.largestLeftOutFraction)
{
  std::vector<LeftOutFrame> leftOut;
  if (AreFew(faults, frames, share))
  {
    for (const auto & [frame, fault] : faults)
    {
      leftOut.push_back({ frame, fault });
    }
  }
  return leftOut;
}

/** Finds the frames without content in most of their cells, where the other frames have content. */
Faults
FindEmptyFrames(const FrameThumbnails & thumbnails, const Indices & cells)
{
  std::vector<double> uniformFractions;
  for (std::size_t t = 0; t < thumbnails.NumberOfFrames(); ++t)
  {
    uniformFractions.push_back(thumbnails.UniformFractionOf(t));
  }
  const bool areOthersEven = QuantileOf(uniformFractions, 0.5) > InMoments.largestEmptyFraction;
  Faults     faults;
  for (std::size_t t = 0; t < thumbnails.NumberOfFrames(); ++t)
  {
    const auto lost = std::count_if(
      cells.begin(), cells.end(), [&](std::size_t cell) { return !std::isfinite(thumbnails.MeanOf(t, cell)); });
    if (static_cast<double>(lost) > InMoments.largestEmptyFraction * static_cast<double>(cells.size()))
    {
      faults.emplace(t, FrameFault::NotFinite);
    }
    else if (!areOthersEven && uniformFractions[t] > InMoments.largestEmptyFraction)
    {
      faults.emplace(t, FrameFault::NoNoise);
    }
  }
  return faults;
}

/** Returns the mean of the frames \a chosen over the \a cells [DN]. */
std::vector<double>
MeanOfFrames(const FrameThumbnails & thumbnails, const Indices & cells, const Indices & chosen)
{
  std::vector<double> mean(cells.size(), 0.0);
  for (const std::size_t t : chosen)
  {
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      mean[i] += thumbnails.MeanOf(t, cells[i]) / static_cast<double>(chosen.size());
    }
  }
  return mean;
}

/** Mean square deviations of frames from the mean frame [DN^2], also in two units in which the frames of one scene have
 * similar values. Vibration and local changes of the illumination change a frame in proportion to its signal; noise
 * exists without signal, too. */
struct Misfits
{
  std::vector<double> all;
  std::vector<double> ofLight;
  std::vector<double> ofBoth;
};

/** Computes the deviations of the frames \a kept from \a mean. */
Misfits
FindMisfits(const FrameThumbnails &     thumbnails,
            const Indices &             cells,
            const Indices &             kept,
            const std::vector<double> & mean)
{
  Misfits misfits;
  for (const std::size_t t : kept)
  {
    const FrameFit fit = FitMostCells(mean, thumbnails.MeansOf(t, cells));
    const double   light = fit.factor * fit.factor;
    misfits.all.push_back(fit.misfit);
    misfits.ofLight.push_back(light > 0.0 ? fit.misfit / light : std::numeric_limits<double>::max());
    misfits.ofBoth.push_back(fit.misfit / std::max(1.0, light));
  }
  return misfits;
}

/** Returns the distance of each of \a values above their median, in units of their standard deviation [1]. The standard
 * deviation is estimated from the median deviation, and is at least the statistical error of a mean square over the
 * number of \a cells. */
std::vector<double>
HowFar(const std::vector<double> & values, std::size_t cells)
{
  const auto [median, sd] = CentreOf(values);
  const double spread =
    std::max({ sd, median * std::sqrt(2.0 / static_cast<double>(cells)), std::numeric_limits<double>::min() });
  std::vector<double> far;
  far.reserve(values.size());
  for (const double value : values)
  {
    far.push_back((value - median) / spread);
  }
  return far;
}

/** Returns the distance of the frames from the others, the smaller one in both units [1]. */
std::vector<double>
HowUnlike(const Misfits & misfits, std::size_t cells)
{
  std::vector<double>       far = HowFar(misfits.ofLight, cells);
  const std::vector<double> ofBoth = HowFar(misfits.ofBoth, cells);
  std::transform(
    far.begin(), far.end(), ofBoth.begin(), far.begin(), [](double a, double b) { return std::min(a, b); });
  return far;
}

/** Finds the frames among \a kept whose shape differs from the mean of the others. */
Indices
FindOtherShapes(const FrameThumbnails & thumbnails, const Indices & cells, const Indices & kept)
{
  std::vector<double> mean = MeanOfFrames(thumbnails, cells, kept);
  Misfits             misfits = FindMisfits(thumbnails, cells, kept, mean);
  std::vector<double> unlike = HowUnlike(misfits, cells.size());
  for (int round = 0; round < InMoments.roundsOfUnlikeFrames; ++round)
  {
    // Mean of the frames that are most alike: as many frames as may be left out are excluded.
    const double edge = QuantileOf(unlike, 1.0 - InMoments.largestLeftOutFraction);
    Indices      alike;
    for (std::size_t k = 0; k < kept.size(); ++k)
    {
      if (unlike[k] <= edge)
      {
        alike.push_back(kept[k]);
      }
    }
    mean = MeanOfFrames(thumbnails, cells, alike);
    misfits = FindMisfits(thumbnails, cells, kept, mean);
    unlike = HowUnlike(misfits, cells.size());
  }
  std::vector<double> noise;
  for (const std::size_t t : kept)
  {
    noise.push_back(thumbnails.NoiseOf(t));
  }
  // Both are upper bounds of the noise of the mean of a cell: texture adds to the first, vibration to the second.
  const double cellVariance = std::min(QuantileOf(noise, 0.5), QuantileOf(misfits.ofBoth, 0.5));
  const double pixelVariance = thumbnails.PixelsOfCell() * cellVariance;
  const double least = InMoments.leastUnlikeEffect * pixelVariance * static_cast<double>(kept.size());
  Indices      found;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    if (unlike[k] > InMoments.unlikeZ && misfits.all[k] > least)
    {
      found.push_back(kept[k]);
    }
  }
  return found;
}

Indices
FramesWithout(const Faults & faults, std::size_t frames)
{
  Indices kept = AllBelow(frames);
  kept.erase(std::remove_if(kept.begin(), kept.end(), [&](std::size_t t) { return faults.count(t) > 0; }), kept.end());
  return kept;
}
} // namespace

const char *
NameOf(FrameFault fault)
{
  switch (fault)
  {
    case FrameFault::NotFinite:
      return "not-finite";
    case FrameFault::NoNoise:
      return "no-noise";
    case FrameFault::OtherShape:
      return "other-shape";
    case FrameFault::OtherOffset:
      return "other-offset";
    case FrameFault::OtherNoise:
      break;
  }
  return "other-noise";
}

std::vector<LeftOutFrame>
FindUnlikeFrames(const FrameThumbnails & thumbnails)
{
  const std::size_t frames = thumbnails.NumberOfFrames();
  const Indices     cells = FindUsableCells(thumbnails);
  if (frames <= MinimumFrames || cells.size() < InMoments.fewestThumbnailCells)
  {
    return {};
  }
  Faults faults = FindEmptyFrames(thumbnails, cells);
  if (AreFew(faults, frames, InMoments.largestLeftOutFraction))
  {
    const Indices kept = FramesWithout(faults, frames);
    const Indices finite = FiniteCells(thumbnails, cells, kept);
    const bool    canTell = finite.size() >= InMoments.fewestThumbnailCells;
    for (const std::size_t t : canTell ? FindOtherShapes(thumbnails, finite, kept) : Indices())
    {
      faults.emplace(t, FrameFault::OtherShape);
    }
  }
  return AsList(faults, frames);
}

std::vector<LeftOutFrame>
JoinUnlikeFrames(const std::vector<std::vector<LeftOutFrame>> & ofParts, std::size_t frames, double largestShare)
{
  Faults faults;
  for (const std::vector<LeftOutFrame> & part : ofParts)
  {
    for (const auto & [frame, fault] : part)
    {
      faults.emplace(frame, fault);
    }
  }
  return AsList(faults, frames, largestShare);
}

std::vector<std::size_t>
NumbersOf(const std::vector<LeftOutFrame> & frames)
{
  std::vector<std::size_t> numbers;
  std::transform(
    frames.begin(), frames.end(), std::back_inserter(numbers), [](const LeftOutFrame & each) { return each.frame; });
  return numbers;
}

} // namespace sensornoise
