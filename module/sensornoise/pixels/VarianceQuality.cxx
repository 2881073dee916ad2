// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceQuality.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/StaticPixels.h"
#include "sensornoise/pixels/VarianceFit.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sensornoise
{

VarianceLine
FitFlatHalf(const VarianceFit &               fit,
            const ProjectedVariance &         projected,
            const ClassFit &                  classes,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor)
{
  const auto   end = classes.pixels.begin() + static_cast<std::ptrdiff_t>(classes.firstBad);
  const double total = std::accumulate(classes.pixels.begin(), end, 0.0);
  std::uint8_t last = 0;
  for (double sum = classes.pixels[0]; last + 1U < classes.firstBad && 2.0 * sum < total;)
  {
    sum += classes.pixels[++last];
  }
  std::vector<std::uint8_t> flat(mask.size());
  ForPixels(mask.size(),
            parallelFor,
            [last, mask = mask.data(), classOf = projected.GetClasses().data(), own = flat.data()](std::size_t p) {
              own[p] = classOf[p] <= last ? mask[p] : 0;
            });
  return fit.LineOfPart(flat);
}

} // namespace sensornoise
