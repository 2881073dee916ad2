// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/OutlierPixels.h"

#include "base/BoxSum.h"
#include "base/Constants.h"
#include "base/Stencils.h"
#include "scene/Constants.h"
#include "scene/InnerBlocks.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Marks the pixels [begin, end) whose variance \a model does not explain. The model is passed by value: by reference
 * it could alias the output, which prevents vectorization. */
void
MarkOutlierPixels(const ReferenceFrame & frame,
                  InitialNoiseModel      model,
                  std::size_t            begin,
                  std::size_t            end,
                  std::uint8_t *         unexplained)
{
  const double * const       mean = frame.mean.data();
  const double * const       level = frame.neighbourMean.data();
  const double * const       variance = frame.variance.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  const double               leastDn2 = InScene.leastFractionOfDarkest * model.interceptDn2;
  for (std::size_t p = begin; p < end; ++p)
  {
    const auto [gx, gy] = ApplyGradient(mean, width, p);
    const double expected = std::max(leastDn2, model.RawVariance(level[p], gx, gy));
    const bool   isAbove = variance[p] > model.largestRatio * expected;
    unexplained[p] = usable[p] != 0 && isAbove ? 1 : 0;
  }
}
} // namespace

std::vector<std::uint8_t>
FindOutlierPixels(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor)
{
  std::vector<std::uint8_t> unexplained(frame.mean.size(), 0);
  ForInnerBlocks(frame.geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
    MarkOutlierPixels(frame, model, begin, end, unexplained.data());
  });
  const std::size_t         width = frame.geometry.width;
  const auto                rows = [&] { return RowsOf(unexplained, width); };
  std::vector<std::uint8_t> crowded(unexplained.size());
  ForBoxRows(rows, width, frame.geometry.height, 3, parallelFor, [&](std::size_t y, const double * crowd) {
    const double most = InCommon.largestOutlierFraction * 49.0;
    std::transform(crowd,
                   crowd + width,
                   unexplained.data() + y * width,
                   crowded.data() + y * width,
                   [most](double near, std::uint8_t own) { return near > most ? std::uint8_t{ 2 } : own; });
  });
  return crowded;
}

} // namespace sensornoise
