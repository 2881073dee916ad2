// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceQuality.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/pixels/FarVariance.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceFit.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

VarianceLine
FitFlatHalf(const ProjectedVariance &         projected,
            const std::vector<std::uint8_t> & mask,
            const VarianceLine &              line,
            const ParallelFor &               parallelFor)
{
  std::array<std::size_t, ProjectedVariance::Classes> counts{};
  std::size_t                                         total = 0;
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    counts[projected.ClassOf(p)] += mask[p];
    total += mask[p];
  }
  std::size_t last = 0;
  for (std::size_t sum = counts[0]; last + 1 < counts.size() && 2 * sum < total; sum += counts[++last])
  {
  }
  std::vector<std::uint8_t> flat = mask;
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    flat[p] = projected.ClassOf(p) <= last ? mask[p] : 0;
  }
  return FitVarianceLine(projected.GetData(flat), parallelFor, line, 3, TrimRule::Distance);
}

} // namespace sensornoise
