// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/MedianLine.h"

#include "base/Quantiles.h"
#include "pixels/ChiSquareTrim.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

std::optional<VarianceLine>
FitMedians(const VarianceData & data, const ChiSquareTrim & trim)
{
  const auto          sample = SamplePixels(data.mask, data.pixels);
  VarianceLine        line;
  std::vector<double> level;
  for (const std::size_t p : sample)
  {
    level.push_back(data.neighbourMean[p]);
    line.pivotDn += data.mean[p] / static_cast<double>(sample.size());
  }
  constexpr std::size_t bins = 40;
  const auto            binOf = BinsOfEqualCount(level, bins);
  std::vector<double>   value;
  std::vector<double>   centred;
  std::vector<double>   count(bins, 0.0);
  for (std::size_t i = 0; i < sample.size(); ++i)
  {
    value.push_back(data.variance[sample[i]] / trim.Of(data.dof[sample[i]]).median);
    centred.push_back(data.mean[sample[i]] - line.pivotDn);
    count[binOf[i]] += 1.0;
  }
  // Medians on both axes: if a bin holds parts of two patches, both medians are from the larger part.
  const auto medians = MediansOfBins(value, binOf, bins);
  const auto levels = MediansOfBins(centred, binOf, bins);
  double     s0 = 0.0, s1 = 0.0, s2 = 0.0, r0 = 0.0, r1 = 0.0;
  double     lowest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < bins; ++b)
  {
    if (count[b] > InPixels.fewestPixelsOfBin && medians[b] > 0.0)
    {
      const double w = count[b] / (medians[b] * medians[b]);
      const double x = levels[b];
      s0 += w;
      s1 += w * x;
      s2 += w * x * x;
      r0 += w * medians[b];
      r1 += w * x * medians[b];
      lowest = std::min(lowest, medians[b]);
    }
  }
  const double determinant = s0 * s2 - s1 * s1;
  if (!(determinant > 1e-12 * s0 * s2) || !std::isfinite(lowest))
  {
    return std::nullopt;
  }
  line.lowestDn2 = std::max(1e-9, InPixels.lowestShare * lowest);
  line.gain = (s0 * r1 - s1 * r0) / determinant;
  line.intercept = (s2 * r0 - s1 * r1) / determinant - line.gain * line.pivotDn;
  return line;
}

} // namespace sensornoise
