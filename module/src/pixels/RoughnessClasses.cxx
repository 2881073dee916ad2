// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/RoughnessClasses.h"

#include "base/BoxSum.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "base/Constants.h"
#include "base/Stencils.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Limits of the classes in rising order. They are infinite if there are no pixels, so that all pixels are of class
 * 0. */
using ClassEdges = std::array<double, RoughnessClasses - 1>;

/** Returns the energy of the derivatives of every usable pixel, which a motion turns into variance; 0 for other
 * pixels. */
std::vector<float>
EnergyMap(const ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  const std::size_t width = frame.geometry.width;
  auto              energy = MakeMap<float>(frame.mean.size(), parallelFor);
  ForBoxBands(frame.geometry.height, parallelFor, [&](std::size_t first, std::size_t last) {
    last = std::min(last, frame.geometry.height - StencilMargin);
    for (std::size_t y = std::max(first, StencilMargin); y < last; ++y)
    {
      const double * const       mean = frame.mean.data() + y * width;
      const std::uint8_t * const usable = frame.usable.data() + y * width;
      float * const              own = energy.data() + y * width;
      for (std::size_t x = StencilMargin; x + StencilMargin < width; ++x)
      {
        const auto found = static_cast<float>(StencilEnergyAt(mean, width, x));
        own[x] = usable[x] != 0 ? found : 0.0F;
      }
    }
  });
  return energy;
}

/** Returns the sum of a map over the square about a pixel, cut at the frame's border. */
double
SumAbout(const std::vector<float> & map, const FrameGeometry & geometry, std::size_t p, std::size_t radius)
{
  const std::size_t x = p % geometry.width;
  const std::size_t y = p / geometry.width;
  const std::size_t left = x - std::min(x, radius);
  const std::size_t right = std::min(x + radius, geometry.width - 1);
  double            sum = 0.0;
  for (std::size_t row = y - std::min(y, radius); row <= std::min(y + radius, geometry.height - 1); ++row)
  {
    for (std::size_t k = row * geometry.width + left; k <= row * geometry.width + right; ++k)
    {
      sum += map[k];
    }
  }
  return sum;
}

/** Returns the limits of 15 classes up to the quantile 0.9 and of 9 classes above, 8 of them up to 0.995. */
ClassEdges
EdgesOf(std::vector<double> roughness)
{
  ClassEdges edges;
  edges.fill(std::numeric_limits<double>::infinity());
  std::sort(roughness.begin(), roughness.end());
  for (std::size_t c = 1; c < RoughnessClasses && !roughness.empty(); ++c)
  {
    const double rank = c <= 15 ? 0.06 * static_cast<double>(c) : 0.92 + 0.075 * static_cast<double>(c - 16) / 7.0;
    edges[c - 1] = SortedQuantile(roughness, rank);
  }
  return edges;
}

/** Sets the classes of a row of pixels from their sums of the energy. All limits are compared, without branches. */
void
ClassifyRow(const double *            sums,
            const float *             neighbourMean,
            const InitialNoiseModel & model,
            const ClassEdges &        edges,
            std::size_t               width,
            std::uint8_t *            classOf)
{
  constexpr std::size_t together = 64; // pixels whose counts stay in the first-level cache
  for (std::size_t first = 0; first < width; first += together)
  {
    const std::size_t pixels = std::min(together, width - first);
    double            roughness[together] = {};
    double            below[together] = {}; // number of limits below the roughness
    for (std::size_t k = 0; k < pixels; ++k)
    {
      roughness[k] = sums[first + k] / model.NoiseVariance(neighbourMean[first + k]);
    }
    for (const double edge : edges)
    {
      for (std::size_t k = 0; k < together; ++k)
      {
        below[k] += edge < roughness[k] ? 1.0 : 0.0;
      }
    }
    for (std::size_t k = 0; k < pixels; ++k)
    {
      classOf[first + k] = static_cast<std::uint8_t>(static_cast<int>(below[k]));
    }
  }
}
} // namespace

std::vector<std::uint8_t>
ClassifyRoughness(const ReferenceFrame &            frame,
                  const InitialNoiseModel &         model,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor)
{
  const std::size_t width = frame.geometry.width;
  const double      sd = std::sqrt(std::max(model.vibrationXPixels2, model.vibrationYPixels2));
  const auto        radius = static_cast<std::size_t>(
    sd < InPixels.smallMotion ? 2.0 : 2.0 + std::ceil(InPixels.motionSds * std::min(sd, InPixels.largestMotion)));
  const std::vector<float>       energy = EnergyMap(frame, parallelFor);
  const std::vector<std::size_t> pixels = SamplePixels(mask);
  std::vector<double>            sample(pixels.size());
  ForPixels(pixels.size(), parallelFor, [&](std::size_t k) {
    const std::size_t p = pixels[k];
    sample[k] = SumAbout(energy, frame.geometry, p, radius) / model.NoiseVariance(frame.neighbourMean[p]);
  });
  const ClassEdges edges = EdgesOf(std::move(sample));
  auto             classOf = MakeMap<std::uint8_t>(mask.size(), parallelFor);
  const auto       rows = [&] { return RowsOf(energy, width); };
  ForBoxRows(rows, width, frame.geometry.height, radius, parallelFor, [&](std::size_t y, const double * sums) {
    ClassifyRow(sums, frame.neighbourMean.data() + y * width, model, edges, width, classOf.data() + y * width);
  });
  return classOf;
}

namespace
{
/** Bins of the level whose square roots have equal widths, because the standard deviation of shot noise grows with the
 * square root. */
class LevelBins
{
public:
  LevelBins(const std::vector<float> & levels, const std::vector<std::uint8_t> & usable)
    : m_Levels(levels)
  {
    double highest = -std::numeric_limits<double>::infinity();
    m_LowestDn = -highest;
    for (std::size_t p = 0; p < levels.size(); ++p)
    {
      if (usable[p] != 0)
      {
        m_LowestDn = std::min<double>(m_LowestDn, levels[p]);
        highest = std::max<double>(highest, levels[p]);
      }
    }
    m_RangeDn = std::max(0.0, highest - m_LowestDn);
  }

  std::size_t
  Of(std::size_t p) const
  {
    const double fraction = std::sqrt(std::max(0.0, m_Levels[p] - m_LowestDn) / std::max(1e-300, m_RangeDn));
    return std::min(InPixels.levelBins - 1,
                    static_cast<std::size_t>(fraction * static_cast<double>(InPixels.levelBins)));
  }
  std::vector<std::size_t>
  CountsOf(const std::vector<std::uint8_t> & mask) const
  {
    std::vector<std::size_t> counts(InPixels.levelBins, 0);
    for (std::size_t p = 0; p < mask.size(); ++p)
    {
      counts[this->Of(p)] += mask[p] != 0 ? 1U : 0U;
    }
    return counts;
  }

private:
  const std::vector<float> & m_Levels;
  double                     m_LowestDn;
  double                     m_RangeDn;
};

/** Returns one more than the highest bin that has enough pixels. */
std::size_t
EndOf(const std::vector<std::size_t> & counts)
{
  std::size_t end = counts.size();
  while (end > 0 && counts[end - 1] < InPixels.leastPixelsOfLevel)
  {
    --end;
  }
  return end;
}

/** Returns for each bin the median roughness class of its pixels. */
std::vector<std::size_t>
FindMedianClasses(const ProjectedVariance & projected, const std::vector<std::uint8_t> & usable, const LevelBins & bins)
{
  std::vector<std::vector<std::size_t>> counts(InPixels.levelBins,
                                               std::vector<std::size_t>(ProjectedVariance::Classes, 0));
  for (std::size_t p = 0; p < usable.size(); ++p)
  {
    counts[bins.Of(p)][projected.ClassOf(p)] += usable[p] != 0 ? 1U : 0U;
  }
  std::vector<std::size_t> medians;
  for (const std::vector<std::size_t> & own : counts)
  {
    std::size_t total = 0;
    for (const std::size_t count : own)
    {
      total += count;
    }
    std::size_t median = 0;
    for (std::size_t sum = own[0]; 2 * sum < total && median + 1 < own.size();)
    {
      sum += own[++median];
    }
    medians.push_back(median);
  }
  return medians;
}

/** Returns the line through the median level and variance of each bin, weighted by the inverse square of the
 * variance. */
VarianceLine
LineThroughMedians(const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask, const LevelBins & bins)
{
  const VarianceData               data = projected.GetData(mask);
  std::vector<std::vector<double>> levels(InPixels.levelBins);
  std::vector<std::vector<double>> variances(InPixels.levelBins);
  for (const std::size_t p : SamplePixels(mask.data(), mask.size(), mask.size()))
  {
    levels[bins.Of(p)].push_back(data.mean[p]);
    variances[bins.Of(p)].push_back(data.variance[p]);
  }
  VarianceLine    line;
  Eigen::Matrix2d gram = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double          lowest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < InPixels.levelBins; ++b)
  {
    if (levels[b].size() < InPixels.leastPixelsOfLevel)
    {
      continue;
    }
    const double variance = Quantile(variances[b], 0.5);
    if (variance > 0.0)
    {
      const Eigen::Vector2d row(Quantile(levels[b], 0.5), 1.0);
      gram += row * row.transpose() / (variance * variance);
      right += row / variance;
      lowest = std::min(lowest, variance);
    }
  }
  const Eigen::Vector2d solution = gram.ldlt().solve(right);
  line.gain = solution(0);
  line.intercept = solution(1);
  line.pivotDn = gram(1, 1) > 0.0 ? gram(0, 1) / gram(1, 1) : 0.0;
  line.lowestDn2 = InCommon.lowestFraction * lowest;
  line.isDetermined = solution.allFinite() && std::isfinite(lowest) && line.gain > 0.0;
  return line;
}
} // namespace

std::vector<std::uint8_t>
MaskOfFlatClasses(const ProjectedSquares &          squares,
                  const std::vector<std::uint8_t> & usable,
                  const ParallelFor &               parallelFor)
{
  const auto                last = static_cast<std::uint8_t>(InPixels.flatFraction * ProjectedVariance::Classes);
  std::vector<std::uint8_t> mask(usable.size());
  ForPixels(mask.size(),
            parallelFor,
            [=, usable = usable.data(), classOf = squares.GetClasses().data(), own = mask.data()](std::size_t p) {
              own[p] = usable[p] != 0 && classOf[p] <= last ? 1 : 0;
            });
  return mask;
}

std::optional<BrighterPixels>
FindBrighterPixels(const ProjectedVariance &         projected,
                   const std::vector<std::uint8_t> & usable,
                   const std::vector<std::uint8_t> & flat,
                   const ParallelFor &               parallelFor)
{
  const LevelBins   bins(projected.GetFrame().neighbourMean, usable);
  const std::size_t covered = EndOf(bins.CountsOf(flat));
  const std::size_t end = EndOf(bins.CountsOf(usable));
  // The bins are of square roots: half of them reach a quarter of the signal.
  if (covered == 0 || 2 * covered >= end)
  {
    return std::nullopt;
  }
  const std::vector<std::size_t> medians = FindMedianClasses(projected, usable, bins);
  BrighterPixels                 found;
  found.mask = flat;
  found.beyond.resize(flat.size());
  ForPixels(flat.size(), parallelFor, [&](std::size_t p) {
    const std::size_t bin = bins.Of(p);
    const bool        isBeyond = usable[p] != 0 && bin >= covered && projected.ClassOf(p) <= medians[bin];
    found.beyond[p] = isBeyond ? 1 : 0;
    found.mask[p] = isBeyond ? 1 : found.mask[p];
  });
  found.through = LineThroughMedians(projected, found.mask, bins);
  if (!found.through.isDetermined)
  {
    return std::nullopt;
  }
  return found;
}

void
SetRatiosOfLevels(RejectionModel & model, const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask)
{
  /** Sums over the pixels of a bin. */
  struct BinSums
  {
    double pixels{ 0.0 };
    double level{ 0.0 };
    double ratio{ 0.0 };
  };
  const VarianceData             data = projected.GetData(mask);
  const LevelBins                bins(projected.GetFrame().neighbourMean, mask);
  const std::vector<std::size_t> medians = FindMedianClasses(projected, mask, bins);
  std::vector<BinSums>           sums(InPixels.levelBins);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    const std::size_t bin = bins.Of(p);
    if (mask[p] != 0 && projected.ClassOf(p) <= medians[bin])
    {
      sums[bin].pixels += 1.0;
      sums[bin].level += data.mean[p];
      sums[bin].ratio += data.variance[p] / model.line.At(data.mean[p]);
    }
  }
  model.levels.clear();
  model.ratios.clear();
  for (const BinSums & own : sums)
  {
    const double level = own.level / std::max(1.0, own.pixels);
    if (own.pixels >= static_cast<double>(InPixels.leastPixelsOfLevel) &&
        (model.levels.empty() || level > model.levels.back()))
    {
      model.levels.push_back(level);
      model.ratios.push_back(std::max(InCommon.leastVarianceRatio, own.ratio / own.pixels));
    }
  }
}

bool
AgreesWithLine(const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask, const VarianceLine & line)
{
  const VarianceData data = projected.GetData(mask);
  double             pixels = 0.0;
  double             near = 0.0;
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    if (mask[p] != 0)
    {
      const double expected = line.At(data.mean[p]);
      const double limit = Significance.oneTest * std::sqrt(line.SamplingVariance(data.dof[p], expected));
      pixels += 1.0;
      near += std::abs(data.variance[p] - expected) < limit ? 1.0 : 0.0;
    }
  }
  return near > InPixels.leastFractionNearLine * pixels;
}

} // namespace sensornoise
