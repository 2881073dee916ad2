// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/ShiftInstruments.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/series/Constants.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
/** Adds \a weight times the values of \a from to those of \a to. */
void
AddScaled(const double * from, double weight, double * to, std::size_t count)
{
  std::transform(to, to + count, from, to, [weight](double sum, double value) { return sum + weight * value; });
}
} // namespace

std::vector<double>
SmoothedDerivative(const ReferenceFrame & frame, StencilIndex k, const ParallelFor & parallelFor)
{
  const double        side = 2.0 * static_cast<double>(InSeries.instrumentRadius) + 1.0;
  const std::size_t   width = frame.geometry.width;
  const std::size_t   height = frame.geometry.height;
  std::vector<double> map(frame.mean.size(), 0.0);
  parallelFor(height, [&](std::size_t y) {
    if (y >= StencilMargin && y + StencilMargin < height && width > 2 * StencilMargin)
    {
      const std::size_t first = y * width + StencilMargin;
      const std::size_t count = width - 2 * StencilMargin;
      double * const    row = map.data() + first;
      for (const StencilTap & tap : MotionStencils()[k].taps)
      {
        AddScaled(frame.mean.data() + static_cast<std::ptrdiff_t>(first) + tap.Offset(width), tap.weight, row, count);
      }
      std::transform(row, row + count, row, [side](double d) { return d / (side * side * side * side); });
    }
  });
  const std::vector<double> once = BoxSum(map, width, height, InSeries.instrumentRadius, parallelFor);
  BoxSum(once, width, height, InSeries.instrumentRadius, parallelFor, map);
  return map;
}

std::vector<double>
InstrumentWeight(const ReferenceFrame &            frame,
                 const ProvisionalModel &          model,
                 const std::vector<std::uint8_t> & mask,
                 const ParallelFor &               parallelFor)
{
  const std::size_t         reach = InSeries.missingRadius;
  const std::size_t         radius = InSeries.noiseRadius;
  const std::size_t         width = frame.geometry.width;
  const std::size_t         height = frame.geometry.height;
  std::vector<std::uint8_t> missing(mask.size(), 0);
  std::vector<double>       noise(mask.size());
  parallelFor(height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x)
    {
      const std::size_t p = y * width + x;
      const bool        isInner =
        x >= StencilMargin && x + StencilMargin < width && y >= StencilMargin && y + StencilMargin < height;
      missing[p] = isInner && mask[p] == 0 ? 1 : 0;
      noise[p] = model.NoiseVariance(frame.neighbourMean[p]);
    }
  });
  std::vector<std::uint8_t> complete(mask.size());
  std::vector<double>       smooth = BoxSum(missing, width, height, reach, parallelFor);
  std::transform(
    smooth.begin(), smooth.end(), complete.begin(), [](double near) { return static_cast<std::uint8_t>(near < 0.5); });
  std::vector<double> weight = BoxSum(complete, width, height, reach, parallelFor);
  BoxSum(noise, width, height, radius, parallelFor, smooth);
  const double side = 2.0 * static_cast<double>(radius) + 1.0;
  const double reachSide = 2.0 * static_cast<double>(reach) + 1.0;
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      weight[p] *= side * side / (reachSide * reachSide * smooth[p]);
    }
  });
  return weight;
}

ShiftInstruments
MakeShiftInstruments(const ReferenceFrame &            frame,
                     const ProvisionalModel &          model,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  ShiftInstruments instruments{ SmoothedDerivative(frame, StencilX, parallelFor),
                                SmoothedDerivative(frame, StencilY, parallelFor),
                                InstrumentWeight(frame, model, mask, parallelFor) };
  return instruments;
}

} // namespace sensornoise
