// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ReferenceFrame.h"

#include "base/ParallelWork.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns the mean of the finite neighbours of a pixel [DN]; 0 if there is none. */
double
MeanOfNeighbours(const std::vector<double> & mean, const FrameGeometry & geometry, std::size_t x, std::size_t y)
{
  double sum = 0.0;
  int    count = 0;
  for (std::size_t row = y - std::min<std::size_t>(y, 1); row <= std::min(y + 1, geometry.height - 1); ++row)
  {
    for (std::size_t column = x - std::min<std::size_t>(x, 1); column <= std::min(x + 1, geometry.width - 1); ++column)
    {
      const double level = mean[row * geometry.width + column];
      if (std::isfinite(level) && (row != y || column != x))
      {
        sum += level;
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : 0.0;
}

/** Computes the means of the neighbours in row \a y. Most pixels have 8 finite neighbours: their sum is computed
 * without a test of each one. If it is not finite, the mean is computed again from the finite ones. */
void
FillNeighbourMeans(const std::vector<double> & mean, const FrameGeometry & geometry, std::size_t y, double * means)
{
  const std::size_t width = geometry.width;
  if (y > 0 && y + 1 < geometry.height)
  {
    const double * const here = mean.data() + y * width;
    const double * const above = here - width;
    const double * const below = here + width;
    for (std::size_t x = 1; x + 1 < width; ++x)
    {
      means[x] =
        (above[x - 1] + above[x] + above[x + 1] + here[x - 1] + here[x + 1] + below[x - 1] + below[x] + below[x + 1]) /
        8.0;
    }
  }
  for (std::size_t x = 0; x < width; ++x)
  {
    if (x == 0 || x + 1 == width || y == 0 || y + 1 == geometry.height || !std::isfinite(means[x]))
    {
      means[x] = MeanOfNeighbours(mean, geometry, x, y);
    }
  }
}

/** Marks the usable pixels of row \a y, which is not next to the border. */
void
FillUsable(const std::vector<double> &       variance,
           const std::vector<std::uint8_t> & valid,
           std::size_t                       width,
           std::size_t                       y,
           std::uint8_t *                    usable)
{
  const double * const       own = variance.data() + y * width;
  const std::uint8_t * const here = valid.data() + y * width;
  const std::uint8_t * const above = here - width;
  const std::uint8_t * const below = here + width;
  // Integers instead of booleans avoid branches.
  const auto column = [&](std::size_t x) { return above[x] != 0 && here[x] != 0 && below[x] != 0 ? 1U : 0U; };
  for (std::size_t x = StencilMargin; x + StencilMargin < width; ++x)
  {
    const bool isComplete = (column(x - 1) & column(x) & column(x + 1)) != 0;
    usable[x] = static_cast<std::uint8_t>(isComplete && own[x] > 0.0 && std::isfinite(own[x]));
  }
}
} // namespace

ReferenceFrame
MakeReferenceFrame(std::vector<double>               mean,
                   std::vector<double>               variance,
                   const std::vector<std::uint8_t> & valid,
                   const FrameGeometry &             geometry,
                   std::size_t                       frames,
                   const ParallelFor &               parallelFor)
{
  const std::size_t width = geometry.width;
  ReferenceFrame    frame;
  frame.geometry = geometry;
  frame.frames = frames;
  frame.mean = std::move(mean);
  frame.variance = std::move(variance);
  frame.usable.assign(frame.mean.size(), 0);
  parallelFor(geometry.height, [&](std::size_t y) {
    if (y >= StencilMargin && y + StencilMargin < geometry.height)
    {
      CallWithAvx2([&] { FillUsable(frame.variance, valid, width, y, frame.usable.data() + y * width); });
    }
  });
  FillNeighbourMean(frame, parallelFor);
  return frame;
}

void
RestoreUnknownMeans(ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  ForBlocks(frame.mean.size(), parallelFor, [&frame](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      frame.mean[p] = std::isnan(frame.variance[p]) ? frame.variance[p] : frame.mean[p];
    }
  });
}

void
FillNeighbourMean(ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  RestoreUnknownMeans(frame, parallelFor); // a value filled in for a pixel must not enter the mean of its neighbours
  frame.neighbourMean = MakeMap<double>(frame.mean.size(), parallelFor);
  parallelFor(frame.geometry.height, [&](std::size_t y) {
    double * const means = frame.neighbourMean.data() + y * frame.geometry.width;
    CallWithAvx2([&] { FillNeighbourMeans(frame.mean, frame.geometry, y, means); });
  });
  ForBlocks(frame.mean.size(), parallelFor, [&frame](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      frame.mean[p] = std::isfinite(frame.mean[p]) ? frame.mean[p] : frame.neighbourMean[p];
    }
  });
}

void
ReleaseNeighbourMean(ReferenceFrame & frame)
{
  std::exchange(frame.neighbourMean, {});
}

} // namespace sensornoise
