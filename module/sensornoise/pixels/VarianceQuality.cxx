/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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

double
IntensityChi2(const VarianceData & data, const VarianceLine & line, const ParallelFor & parallelFor)
{
  // Sums over the pixels of a bin.
  enum : std::size_t
  {
    Weight,
    WeightedExcess, // of the variance over the line's
    BinSums
  };
  constexpr std::size_t bins = 64;
  std::vector<double>   level;
  for (const std::size_t p : SamplePixels({ data.mask, data.mask + data.pixels }))
  {
    level.push_back(data.neighbourMean[p]);
  }
  const std::vector<double> edges = EdgesOfEqualCount(level, bins);
  const auto sums = SumOverBlocks<BinSums * bins>(data.pixels, parallelFor, [&](std::size_t p, auto & s) {
    const double expected = data.mask[p] != 0 ? line.At(data.mean[p]) : 1.0;
    const double ratio = data.variance[p] / expected;
    if (data.mask[p] != 0 && !IsFarOff(ratio, data.freedom[p]))
    {
      double * own = s.data() + BinSums * BinOf(edges, data.neighbourMean[p]);
      own[Weight] += 0.5 * data.freedom[p];
      own[WeightedExcess] += 0.5 * data.freedom[p] * (ratio - 1.0);
    }
  });
  double     chi2 = 0.0;
  double     used = 0.0;
  for (std::size_t b = 0; b < bins; ++b)
  {
    const double * own = sums.data() + BinSums * b;
    if (own[Weight] > 0.0)
    {
      chi2 += own[WeightedExcess] * own[WeightedExcess] / own[Weight];
      used += 1.0;
    }
  }
  return used > 2.0 ? chi2 / (used - 2.0) : 1.0;
}

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
  return FitVarianceLine(projected.GetData(flat), parallelFor, line, 3);
}

} // namespace sensornoise
