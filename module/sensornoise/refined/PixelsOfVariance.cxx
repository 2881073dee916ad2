// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/PixelsOfVariance.h"

#include "sensornoise/base/PixelUse.h"
#include "sensornoise/moments/DarkMaps.h"
#include "sensornoise/moments/KnownOffset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

namespace
{
/** Pixels around an edge over which its surroundings' level is taken: 5 x 5 pixels, the border of usable pixels. */
constexpr std::size_t EdgeMargin = 2;
/** Change of a pixel's variance, along the line, from its own level to that of its surroundings, from which it is an
 * edge [1]. A Gaussian of 1 pixel then misses its variance by a quarter of that. Set by hand: half changes nothing,
 * twice loses 1 % of the read noise of a texture. */
constexpr double LargestEdge = 0.04;
} // namespace

double
BlackLevel(const RefinedSettings & settings, const StillScene & scene, const std::optional<const SceneSeries> & series)
{
  if (settings.offset)
  {
    return settings.offset->valueDn;
  }
  if (series && series->isOffsetTold)
  {
    return std::min(series->offset + scene.model.centreDn, scene.model.darkestDn);
  }
  return std::min(scene.summary.codes.clipLowDn.value_or(0.0), scene.model.darkestDn);
}

std::vector<std::uint8_t>
PixelsOfVariance(const StillScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse)
{
  std::vector<std::uint8_t> chosen = scene.frame.usable;
  const DarkMaps *          dark = settings.offset ? settings.offset->maps.get() : nullptr;
  const auto                leaveOut = [&](std::size_t p, PixelUse use) {
    chosen[p] = 0;
    pixelUse[p] = static_cast<std::uint8_t>(use);
  };
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    const double level = scene.frame.neighbourMean[p];
    const auto & range = settings.levelRangeDn;
    if (chosen[p] != 0 && range && !(level >= range->lowDn && level <= range->highDn))
    {
      leaveOut(p, PixelUse::OutsideRange);
    }
    else if (chosen[p] != 0 && dark && dark->usable.size() == chosen.size() && dark->usable[p] == 0)
    {
      leaveOut(p, PixelUse::Outlier);
    }
  }
  return chosen;
}

void
LeaveOutEdges(const ReferenceFrame &      frame,
              const VarianceLine &        line,
              std::vector<std::uint8_t> & chosen,
              std::vector<std::uint8_t> & pixelUse)
{
  constexpr double  count = (2 * EdgeMargin + 1) * (2 * EdgeMargin + 1);
  const std::size_t width = frame.geometry.width;
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    const std::size_t x = p % width;
    const std::size_t y = p / width;
    const bool        isInside =
      std::min(x, width - 1 - x) >= EdgeMargin && std::min(y, frame.geometry.height - 1 - y) >= EdgeMargin;
    if (chosen[p] == 0 || !isInside)
    {
      continue;
    }
    double sum = 0.0;
    for (std::size_t row = y - EdgeMargin; row <= y + EdgeMargin; ++row)
    {
      const double * const first = frame.mean.data() + row * width + x - EdgeMargin;
      sum = std::accumulate(first, first + 2 * EdgeMargin + 1, sum);
    }
    const double step = line.gain * (sum / count - frame.mean[p]);
    if (std::abs(step) > LargestEdge * line.At(frame.mean[p]))
    {
      chosen[p] = 0;
      pixelUse[p] = static_cast<std::uint8_t>(PixelUse::Edge);
    }
  }
}

} // namespace sensornoise
