// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"

#include "base/Quantiles.h"
#include "scene/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sensornoise
{

namespace
{
constexpr std::size_t LevelBins =
  128; // of equal count, by intensity: saturated areas of 1 % of the frame fill the last one

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
    if (x > 0 && y > 0 && x + 1 < width && y + 1 < geometry.height)
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

/** Returns the median variance of the smoother half of the pixels of each bin, where motion adds little [DN^2]; NaN
 * where a bin has too few. */
std::vector<double>
SmoothMedians(const LevelSample & sample, const std::vector<std::size_t> & binOf)
{
  const double                       middle = QuantileOf(sample.energyDn2, 0.5);
  std::vector<double>                variance;
  std::vector<std::size_t>           bin;
  std::array<std::size_t, LevelBins> count{};
  for (std::size_t i = 0; i < binOf.size(); ++i)
  {
    if (sample.energyDn2[i] <= middle)
    {
      variance.push_back(sample.varianceDn2[i]);
      bin.push_back(binOf[i]);
      ++count[binOf[i]];
    }
  }
  std::vector<double> medians = MediansOfBins(variance, bin, LevelBins);
  for (std::size_t b = 0; b < LevelBins; ++b)
  {
    medians[b] = count[b] < InScene.fewestPixelsOfCell ? std::numeric_limits<double>::quiet_NaN() : medians[b];
  }
  return medians;
}
} // namespace

std::optional<FullWells>
FindFullWells(const StackMaps & maps, const FrameGeometry & geometry)
{
  const LevelSample sample = SampleLevels(maps, geometry);
  if (sample.levelDn.size() < LevelBins * InScene.fewestPixelsOfCell)
  {
    return std::nullopt;
  }
  const std::vector<std::size_t> binOf = BinsOfEqualCount(sample.levelDn, LevelBins);
  const std::vector<double>      levels = MediansOfBins(sample.levelDn, binOf, LevelBins);
  const std::vector<double>      medians = MediansOfBins(sample.varianceDn2, binOf, LevelBins);
  const std::vector<double>      smooth = SmoothMedians(sample, binOf);
  const double                   nearTop = levels.back() - InScene.reachOfFullWells * (levels.back() - levels.front());
  double                         largest = 0.0; // variance next to the full wells
  for (std::size_t b = 0; b < LevelBins; ++b)
  {
    largest = levels[b] >= nearTop && smooth[b] > largest ? smooth[b] : largest;
  }
  const double saturated = InScene.varianceOfFullWells * largest;
  const auto   darkest = std::find_if(smooth.begin(), smooth.end(), [](double v) { return std::isfinite(v); });
  if (!(medians.back() < saturated) || !(medians.back() <= InScene.largestMedianRatio * *darkest))
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
  const double       guard = InScene.guardBandSds * std::sqrt(centre.sd * centre.sd + largest);
  return FullWells{ centre.median, centre.sd, centre.median - guard };
}

} // namespace sensornoise
