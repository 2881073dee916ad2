// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"

#include "base/Quantiles.h"
#include "scene/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t LevelBins = 128; // bins of equal count: saturated areas of 1 % of the frame fill the last bin

/** Pixels sampled from a frame: their level, their variance, and how much the levels around them differ. */
struct LevelSample
{
  std::vector<double> levelDn;
  std::vector<double> varianceDn2;
  std::vector<double> energyDn2; // squared central differences along both axes
};

LevelSample
SampleLevels(const StackMaps & maps, const FrameGeometry & geometry)
{
  LevelSample       sample;
  const std::size_t width = geometry.width;
  for (const std::size_t p : SamplePixels(maps.valid))
  {
    const std::size_t x = p % width;
    const std::size_t y = p / width;
    const bool        isInside = x > 0 && y > 0 && x + 1 < width && y + 1 < geometry.height;
    if (isInside && maps.variance[p] > 0.0) // dead pixels do not vary, at any level
    {
      const double along = maps.mean[p + 1] - maps.mean[p - 1];
      const double down = maps.mean[p + width] - maps.mean[p - width];
      const double energy = along * along + down * down;
      sample.levelDn.push_back(maps.mean[p]);
      sample.varianceDn2.push_back(maps.variance[p]);
      sample.energyDn2.push_back(std::isfinite(energy) ? energy : std::numeric_limits<double>::infinity());
    }
  }
  return sample;
}

/** Returns the variances of the smoother half of the pixels, where motion adds little, by bin [DN^2]. */
std::vector<std::vector<double>>
SmoothVariances(const LevelSample & sample, const std::vector<std::size_t> & binOf)
{
  const double                     middle = QuantileOf(sample.energyDn2, 0.5);
  std::vector<std::vector<double>> variances(LevelBins);
  for (std::size_t i = 0; i < binOf.size(); ++i)
  {
    if (sample.energyDn2[i] <= middle)
    {
      variances[binOf[i]].push_back(sample.varianceDn2[i]);
    }
  }
  return variances;
}
} // namespace

std::optional<FullWells>
FindFullWells(const StackMaps & maps, const FrameGeometry & geometry)
{
  const LevelSample sample = SampleLevels(maps, geometry);
  if (sample.levelDn.size() < LevelBins * InScene.fewestPixelsOfMedian)
  {
    return std::nullopt;
  }
  const std::vector<std::size_t>   binOf = BinsOfEqualCount(sample.levelDn, LevelBins);
  const std::vector<double>        levels = MediansOfBins(sample.levelDn, binOf, LevelBins);
  const std::vector<double>        medians = MediansOfBins(sample.varianceDn2, binOf, LevelBins);
  const double                     signalDn = levels.back() - levels.front();
  const double                     nearTopDn = levels.back() - InScene.reachOfFullWells * signalDn;
  double                           darkest = -1.0; // variance of the darkest pixels
  double                           least = 0.0;    // variance that nearly all pixels next to the full wells exceed
  double                           noise = 0.0;    // median variance of these pixels
  double                           noisyDn = 0.0;  // level of these pixels
  std::vector<std::vector<double>> smooth = SmoothVariances(sample, binOf);
  for (std::size_t b = 0; b < LevelBins; ++b)
  {
    if (smooth[b].size() >= InScene.fewestPixelsOfMedian)
    {
      darkest = darkest < 0.0 ? Quantile(smooth[b], 0.5) : darkest;
      const double low = levels[b] >= nearTopDn ? Quantile(smooth[b], InScene.quantileBelowWells) : 0.0;
      noise = low > least ? Quantile(smooth[b], 0.5) : noise;
      noisyDn = low > least ? levels[b] : noisyDn;
      least = std::max(least, low);
    }
  }
  const double saturated = InScene.varianceOfFullWells * least;
  if (!(medians.back() < saturated) || !(medians.back() <= InScene.largestMedianRatio * darkest))
  {
    return std::nullopt;
  }
  // Shot noise grows at most in proportion to the level above the end of the DN range. Dark pixels of more variance
  // move, and the brightest are the quiet paper of a page.
  const double lowDn = maps.summary.dnRange.clipLowDn.value_or(levels.front()); // not known: no comparison
  const double ofLevels = (levels.front() - lowDn) / (noisyDn - lowDn);
  if (ofLevels > 0.0 && darkest - medians.back() > InScene.largestMedianRatio * ofLevels * (noise - medians.back()))
  {
    return std::nullopt;
  }
  std::size_t first = LevelBins - 1;
  while (first > 0 && medians[first - 1] < saturated)
  {
    --first;
  }
  std::vector<double> full;
  for (std::size_t i = 0; i < binOf.size(); ++i)
  {
    if (binOf[i] >= first && sample.varianceDn2[i] < saturated)
    {
      full.push_back(sample.levelDn[i]);
    }
  }
  const RobustCentre centre = CentreOf(std::move(full));
  const double       guardDn = InScene.guardBandSds * std::sqrt(centre.sd * centre.sd + noise);
  const FullWells    wells{ centre.median, centre.sd, centre.median - guardDn };
  return wells.firstLevelDn > nearTopDn ? std::optional<FullWells>(wells) : std::nullopt;
}

} // namespace sensornoise
