// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ReferenceFrame.h"

#include "base/BoxSum.h"
#include "base/ParallelWork.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace sensornoise
{

namespace
{
/** A row and the rows above and below it, with NaN at the pixels without a mean [DN]. */
struct KnownRows
{
  std::vector<double> above;
  std::vector<double> here;
  std::vector<double> below;

  /** Reads the rows about row \a y. A row outside of the frame is left as it is. */
  void
  Read(const ReferenceFrame & frame, std::size_t y)
  {
    const std::size_t width = frame.geometry.width;
    const auto        read = [&](std::size_t row, std::vector<double> & known) {
      const double * const mean = frame.mean.data() + row * width;
      known.resize(width);
      frame.variance.Visit([&](const auto & variance) {
        for (std::size_t x = 0; x < width; ++x)
        {
          known[x] = std::isnan(variance[row * width + x]) ? std::numeric_limits<double>::quiet_NaN() : mean[x];
        }
      });
    };
    if (y > 0)
    {
      read(y - 1, above);
    }
    read(y, here);
    if (y + 1 < frame.geometry.height)
    {
      read(y + 1, below);
    }
  }
};

/** Returns the mean of the known neighbours of pixel \a x of row \a y, the middle one of \a rows [DN]; 0 if there is
 * none. */
double
MeanOfNeighbours(const KnownRows & rows, const FrameGeometry & geometry, std::size_t x, std::size_t y)
{
  double     sum = 0.0;
  int        count = 0;
  const auto add = [&](const std::vector<double> & row, bool hasPixelItself) {
    for (std::size_t column = x - std::min<std::size_t>(x, 1); column <= std::min(x + 1, geometry.width - 1); ++column)
    {
      if (std::isfinite(row[column]) && (column != x || !hasPixelItself))
      {
        sum += row[column];
        ++count;
      }
    }
  };
  if (y > 0)
  {
    add(rows.above, false);
  }
  add(rows.here, true);
  if (y + 1 < geometry.height)
  {
    add(rows.below, false);
  }
  return count > 0 ? sum / count : 0.0;
}

/** Computes the means of the neighbours in row \a y, the middle one of \a rows. Most pixels have 8 known neighbours:
 * their sum is computed without a test of each one. If it is not finite, the mean is computed again from the known
 * ones. */
void
ComputeNeighbourMeans(const KnownRows & rows, const FrameGeometry & geometry, std::size_t y, float * means)
{
  const std::size_t width = geometry.width;
  if (y > 0 && y + 1 < geometry.height)
  {
    const double * const here = rows.here.data();
    const double * const above = rows.above.data();
    const double * const below = rows.below.data();
    for (std::size_t x = 1; x + 1 < width; ++x)
    {
      means[x] = static_cast<float>(
        (above[x - 1] + above[x] + above[x + 1] + here[x - 1] + here[x + 1] + below[x - 1] + below[x] + below[x + 1]) /
        8.0);
    }
  }
  for (std::size_t x = 0; x < width; ++x)
  {
    if (x == 0 || x + 1 == width || y == 0 || y + 1 == geometry.height || !std::isfinite(means[x]))
    {
      means[x] = static_cast<float>(MeanOfNeighbours(rows, geometry, x, y));
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

void
PackedMeans::Pack(std::vector<double> & means, std::size_t frames, double centreDn, const ParallelFor & parallelFor)
{
  constexpr double most = 2147483647.0;
  m_Frames = static_cast<double>(frames);
  m_CentreDn = centreDn;
  m_Sums = MakeMap<std::int32_t>(means.size(), parallelFor);
  const auto lost = SumOverBlocks<1>(means.size(), parallelFor, [&](std::size_t p, std::array<double, 1> & count) {
    const double sum = std::round((means[p] - centreDn) * m_Frames);
    const bool   isWithin = std::abs(sum) <= most;
    m_Sums[p] = isWithin ? static_cast<std::int32_t>(sum) : 0;
    count[0] += isWithin && static_cast<double>(m_Sums[p]) / m_Frames + centreDn == means[p] ? 0.0 : 1.0;
  });
  lost[0] > 0.0 ? void(std::exchange(m_Sums, {})) : void(std::exchange(means, {}));
}

void
PackedMeans::Unpack(std::vector<double> & means, const ParallelFor & parallelFor)
{
  if (!this->IsEmpty())
  {
    means = MakeMap<double>(m_Sums.size(), parallelFor);
    ForBlocks(means.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
      this->Fill(means.data() + begin, begin, end - begin);
    });
    std::exchange(m_Sums, {});
  }
}

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
  frame.usable.assign(frame.mean.size(), 0);
  parallelFor(geometry.height, [&](std::size_t y) {
    if (y >= StencilMargin && y + StencilMargin < geometry.height)
    {
      CallWithAvx2([&] { FillUsable(variance, valid, width, y, frame.usable.data() + y * width); });
    }
  });
  frame.variance = std::move(variance);
  frame.neighbourMean = ComputeNeighbourMean(frame, parallelFor);
  ForBlocks(frame.mean.size(), parallelFor, [&frame](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      const bool isKnown = std::isfinite(frame.mean[p]) && !std::isnan(frame.variance[p]);
      frame.mean[p] = isKnown ? frame.mean[p] : static_cast<double>(frame.neighbourMean[p]);
    }
  });
  return frame;
}

std::vector<float>
ComputeNeighbourMean(const ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  auto neighbourMean = MakeMap<float>(frame.mean.size(), parallelFor);
  ForBoxBands(frame.geometry.height, parallelFor, [&](std::size_t first, std::size_t last) {
    KnownRows rows;
    for (std::size_t y = first; y < last; ++y)
    {
      float * const means = neighbourMean.data() + y * frame.geometry.width;
      rows.Read(frame, y);
      ComputeNeighbourMeans(rows, frame.geometry, y, means);
    }
  });
  return neighbourMean;
}

std::vector<double>
KnownMeans(const ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  auto known = MakeMap<double>(frame.mean.size(), parallelFor);
  ForPixels(known.size(), parallelFor, [&](std::size_t p) {
    known[p] = std::isnan(frame.variance[p]) ? frame.variance[p] : frame.mean[p];
  });
  return known;
}

double
LargestMeanDn(const std::vector<double> & mean)
{
  double largest = 0.0;
  for (const double level : mean)
  {
    largest = std::isfinite(level) ? std::max(largest, std::abs(level)) : largest;
  }
  return largest;
}

} // namespace sensornoise
