// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"

#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "moments/Constants.h"
#include "moments/StackFrames.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

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
 * burst, however many they are. At most the fraction \a fraction of the other frames may be left out [1]. */
bool
AreFew(const Faults & faults, std::size_t frames, double fraction)
{
  const auto empty = static_cast<std::size_t>(
    std::count_if(faults.begin(), faults.end(), [](const auto & fault) { return IsEmpty(fault.second); }));
  const auto full = static_cast<double>(frames - std::min(frames, empty));
  return static_cast<double>(faults.size() - empty) <= fraction * full && faults.size() + MinimumFrames <= frames;
}

/** Returns the frames in ascending order; an empty list if they are too many of \a frames. */
std::vector<LeftOutFrame>
AsList(const Faults & faults, std::size_t frames, double fraction = InMoments.largestLeftOutFraction)
{
  std::vector<LeftOutFrame> leftOut;
  if (AreFew(faults, frames, fraction))
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
struct MeanSquares
{
  std::vector<double> all;
  std::vector<double> ofFactor;
  std::vector<double> ofBoth;
};

/** Computes the deviations of the frames \a kept from \a mean. */
MeanSquares
FindMeanSquares(const FrameThumbnails &     thumbnails,
                const Indices &             cells,
                const Indices &             kept,
                const std::vector<double> & mean)
{
  MeanSquares meanSquares;
  for (const std::size_t t : kept)
  {
    const FrameFit fit = FitMostCells(mean, thumbnails.MeansOf(t, cells));
    const double   factorSquare = fit.factor * fit.factor;
    meanSquares.all.push_back(fit.meanSquare);
    meanSquares.ofFactor.push_back(factorSquare > 0.0 ? fit.meanSquare / factorSquare
                                                      : std::numeric_limits<double>::max());
    meanSquares.ofBoth.push_back(fit.meanSquare / std::max(1.0, factorSquare));
  }
  return meanSquares;
}

/** Returns the median of \a values and their standard deviation, which is estimated from the median deviation, and is
 * at least the statistical error of a mean square over the number of \a cells. */
std::pair<double, double>
SpreadOf(const std::vector<double> & values, std::size_t cells)
{
  const auto [median, sd] = CentreOf(values);
  return { median,
           std::max({ sd, median * std::sqrt(2.0 / static_cast<double>(cells)), std::numeric_limits<double>::min() }) };
}

/** Returns the distance of each of \a values above their median, in units of their standard deviation [1]. */
std::vector<double>
DeviationsFromMedian(const std::vector<double> & values, std::size_t cells)
{
  const auto [median, spread] = SpreadOf(values, cells);
  std::vector<double> far;
  far.reserve(values.size());
  for (const double value : values)
  {
    far.push_back((value - median) / spread);
  }
  return far;
}

/** Returns the distance of the frames from the other frames: the smaller of the distances in both units [1]. */
std::vector<double>
DeviationsFromOthers(const MeanSquares & meanSquares, std::size_t cells)
{
  std::vector<double>       far = DeviationsFromMedian(meanSquares.ofFactor, cells);
  const std::vector<double> ofBoth = DeviationsFromMedian(meanSquares.ofBoth, cells);
  std::transform(
    far.begin(), far.end(), ofBoth.begin(), far.begin(), [](double a, double b) { return std::min(a, b); });
  return far;
}

/** Returns the deviations of the frames \a kept from \a mean as rows, of one illumination [DN]. */
Eigen::MatrixXd
DeviationsOf(const FrameThumbnails &     thumbnails,
             const Indices &             cells,
             const Indices &             kept,
             const std::vector<double> & mean)
{
  Eigen::MatrixXd deviations(kept.size(), cells.size());
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    const std::vector<double> frame = thumbnails.MeansOf(kept[k], cells);
    const FrameFit            fit = FitMostCells(mean, frame);
    const double              factor = std::max(1.0, std::abs(fit.factor));
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      deviations(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
        fit.DifferenceOf(mean[i], frame[i]) / factor;
    }
  }
  return deviations;
}

/** Returns the frames among \a kept with \a deviations from the mean that the frames not \a found do not explain.
 *
 * A frame that vibration moves further than the others deviates along the same directions, which are the leading
 * principal components of the others: the terms of a Taylor series of second order in two shifts. \a largest is the
 * largest mean square of the rest [DN^2]. */
Indices
WithoutLargerVibration(const Eigen::MatrixXd & deviations, const Indices & kept, const Indices & found, double largest)
{
  const auto         isFound = [&found](std::size_t t) { return std::binary_search(found.begin(), found.end(), t); };
  const Eigen::Index cells = deviations.cols();
  std::vector<Eigen::Index> others;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    if (!isFound(kept[k]))
    {
      others.push_back(static_cast<Eigen::Index>(k));
    }
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(cells, cells);
  for (const Eigen::Index k : others)
  {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(deviations.row(k).transpose());
  }
  const auto modes = std::min<Eigen::Index>(StencilsOfLowOrder, static_cast<Eigen::Index>(others.size()) / 4);
  const Eigen::MatrixXd vectors = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram).eigenvectors().rightCols(modes);
  Indices               rest;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    const Eigen::RowVectorXd own = deviations.row(static_cast<Eigen::Index>(k));
    const Eigen::RowVectorXd left = own - own * vectors * vectors.transpose();
    if (isFound(kept[k]) && left.squaredNorm() > largest * static_cast<double>(cells))
    {
      rest.push_back(kept[k]);
    }
  }
  return rest;
}

/** Finds the frames among \a kept whose shape differs from the mean of the others. */
Indices
FindOtherShapes(const FrameThumbnails & thumbnails, const Indices & cells, const Indices & kept)
{
  std::vector<double> mean = MeanOfFrames(thumbnails, cells, kept);
  MeanSquares         meanSquares = FindMeanSquares(thumbnails, cells, kept, mean);
  std::vector<double> unlike = DeviationsFromOthers(meanSquares, cells.size());
  for (int round = 0; round < InCommon.roundsOfExclusion; ++round)
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
    meanSquares = FindMeanSquares(thumbnails, cells, kept, mean);
    unlike = DeviationsFromOthers(meanSquares, cells.size());
  }
  std::vector<double> noise;
  for (const std::size_t t : kept)
  {
    noise.push_back(thumbnails.NoiseOf(t));
  }
  // Both are upper bounds of the noise of the mean of a cell: texture adds to the first, vibration to the second.
  const double cellVariance = std::min(QuantileOf(noise, 0.5), QuantileOf(meanSquares.ofBoth, 0.5));
  const double pixelVariance = thumbnails.PixelsOfCell() * cellVariance;
  const double least = InMoments.leastUnlikeEffect * pixelVariance * static_cast<double>(kept.size());
  Indices      found;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    if (unlike[k] > InMoments.unlikeZ && meanSquares.all[k] > least)
    {
      found.push_back(kept[k]);
    }
  }
  if (found.empty())
  {
    return found;
  }
  const auto [median, spread] = SpreadOf(meanSquares.ofBoth, cells.size());
  return WithoutLargerVibration(
    DeviationsOf(thumbnails, cells, kept, mean), kept, found, std::max(least, median + InMoments.unlikeZ * spread));
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
  if (frames <= MinimumFrames || cells.size() < InCommon.fewestCells)
  {
    return {};
  }
  Faults faults = FindEmptyFrames(thumbnails, cells);
  if (AreFew(faults, frames, InMoments.largestLeftOutFraction))
  {
    const Indices kept = FramesWithout(faults, frames);
    const Indices finite = FiniteCells(thumbnails, cells, kept);
    const bool    areEnough = finite.size() >= InCommon.fewestCells;
    for (const std::size_t t : areEnough ? FindOtherShapes(thumbnails, finite, kept) : Indices())
    {
      faults.emplace(t, FrameFault::OtherShape);
    }
  }
  return AsList(faults, frames);
}

std::vector<LeftOutFrame>
JoinUnlikeFrames(const std::vector<std::vector<LeftOutFrame>> & ofParts, std::size_t frames, double largestFraction)
{
  Faults faults;
  for (const std::vector<LeftOutFrame> & part : ofParts)
  {
    for (const auto & [frame, fault] : part)
    {
      faults.emplace(frame, fault);
    }
  }
  return AsList(faults, frames, largestFraction);
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
