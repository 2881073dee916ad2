// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceQuality.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/pixels/FarVariance.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceFit.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sensornoise
{

VarianceLine
FitFlatHalf(const ProjectedVariance &         projected,
            const std::vector<std::uint8_t> & mask,
            const VarianceLine &              line,
            const ParallelFor &               parallelFor)
{
  const auto counts = SumOverBlocks<ProjectedVariance::Classes>(
    mask.size(), parallelFor, [&](std::size_t p, auto & count) { count[projected.ClassOf(p)] += mask[p]; });
  const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
  std::size_t  last = 0;
  for (double sum = counts[0]; last + 1 < counts.size() && 2.0 * sum < total; sum += counts[++last])
  {
  }
  std::vector<std::uint8_t> flat = mask;
  ForPixels(mask.size(), parallelFor, [&](std::size_t p) { flat[p] = projected.ClassOf(p) <= last ? mask[p] : 0; });
  return FitVarianceLine(projected.GetData(flat), parallelFor, line, 3, TrimRule::Distance);
}

} // namespace sensornoise
