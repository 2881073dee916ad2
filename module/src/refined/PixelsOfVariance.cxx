// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/PixelsOfVariance.h"

#include "sensornoise/Report.h"
#include "moments/DarkMaps.h"
#include "sensornoise/Settings.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

double
BlackLevel(const RefinedSettings & settings, const StaticScene & scene, const std::optional<const SceneSeries> & series)
{
  if (settings.offset)
  {
    return settings.offset->valueDn;
  }
  if (series && series->isOffsetIdentifiable)
  {
    return std::min(series->offset + scene.model.centreDn, scene.model.darkestDn);
  }
  return std::min(scene.summary.codes.clipLowDn.value_or(0.0), scene.model.darkestDn);
}

std::vector<std::uint8_t>
PixelsOfVariance(const StaticScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse)
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
  const auto        side = static_cast<double>(2 * InRefined.edgeMargin + 1);
  const std::size_t width = frame.geometry.width;
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    const std::size_t x = p % width;
    const std::size_t y = p / width;
    const bool        isInside = std::min(x, width - 1 - x) >= InRefined.edgeMargin &&
                          std::min(y, frame.geometry.height - 1 - y) >= InRefined.edgeMargin;
    if (chosen[p] == 0 || !isInside)
    {
      continue;
    }
    double sum = 0.0;
    for (std::size_t row = y - InRefined.edgeMargin; row <= y + InRefined.edgeMargin; ++row)
    {
      const double * const first = frame.mean.data() + row * width + x - InRefined.edgeMargin;
      sum = std::accumulate(first, first + 2 * InRefined.edgeMargin + 1, sum);
    }
    const double step = line.gain * (sum / (side * side) - frame.mean[p]);
    if (std::abs(step) > InRefined.largestEdge * line.At(frame.mean[p]))
    {
      chosen[p] = 0;
      pixelUse[p] = static_cast<std::uint8_t>(PixelUse::Edge);
    }
  }
}

} // namespace sensornoise
