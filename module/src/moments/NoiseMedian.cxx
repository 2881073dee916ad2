// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/NoiseMedian.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "sensornoise/Settings.h"
#include "moments/LogDeconvolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{

constexpr std::size_t NumberOfGroups = 20;

/** Median of the logarithm of the variances [log DN^2]. */
struct LogMedian
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Estimates the median of the true variances.
 * \param stepDn quantization step [DN] */
LogMedian
MedianOfTrueVariances(const std::vector<double> & variances, double dof, double stepDn)
{
  // The sum of the squares of T integers is even where their sum is even. The sums of squared deviations of pixels with
  // the same mean are therefore 2 step^2 apart. Each is spread over this distance, for a smooth distribution.
  const double                        cellDn2 = stepDn * stepDn / dof;
  const LogBinning                    binning = MakeLogBinning(variances, cellDn2);
  std::array<LogBins, NumberOfGroups> groups{};
  LogBins                             all{};
  for (std::size_t i = 0; i < variances.size(); ++i)
  {
    const double begin = std::max(0.0, variances[i] - cellDn2);
    binning.Add(begin, variances[i] + cellDn2, groups[i % NumberOfGroups], all);
  }
  const std::vector<LogBins> kernel = ChiSquareKernel(dof, binning);
  LogDeconvolution           whole(all, kernel);
  // Chosen for 6 to 100 frames: fewer iterations are biased by 1 %, more follow the noise of the counts.
  constexpr int iterations = 30;
  whole.Iterate(iterations);
  const double median = whole.GetMedianBin();
  whole.Iterate(2 * iterations);
  const double unsettled = 2.0 * (whole.GetMedianBin() - median);

  std::array<double, NumberOfGroups> without{};
  double                             mean = 0.0;
  for (std::size_t g = 0; g < NumberOfGroups; ++g)
  {
    LogBins rest = all;
    std::transform(
      rest.begin(), rest.end(), groups[g].begin(), rest.begin(), [](double a, double part) { return a - part; });
    LogDeconvolution part(rest, kernel);
    part.Iterate(iterations);
    without[g] = part.GetMedianBin();
    mean += without[g] / NumberOfGroups;
  }
  double scatter = 0.0;
  for (const double other : without)
  {
    scatter += (other - mean) * (other - mean) * (NumberOfGroups - 1.0) / NumberOfGroups;
  }
  const double value = binning.low + binning.width * median;
  // Bias of the logarithm by the width of the intervals.
  const double spreading = std::pow(cellDn2 / std::exp(value), 2) / 3.0;
  return { value, std::hypot(binning.width * std::sqrt(scatter), binning.width * unsettled, spreading) };
}

} // namespace

std::optional<MedianReadNoise>
MedianReadNoiseOf(const std::vector<double> & variancesDn2, double dof, double stepDn)
{
  if (dof < InMoments.leastDofOfMedian || variancesDn2.size() < InMoments.fewestPixelsOfMedian)
  {
    return std::nullopt;
  }
  const double leastDn2 = InCommon.hiddenVariance * stepDn * stepDn;
  const double medianDn2 = QuantileOf(variancesDn2, 0.5);
  if (!(medianDn2 > leastDn2))
  {
    return std::nullopt;
  }
  const LogMedian median = MedianOfTrueVariances(variancesDn2, dof, stepDn);
  const double    trueDn2 = std::exp(median.value);
  if (!(trueDn2 > leastDn2))
  {
    return std::nullopt;
  }
  const double noiseDn = std::sqrt(trueDn2 - stepDn * stepDn / 12.0);
  return MedianReadNoise{ noiseDn, 0.5 * trueDn2 * median.standardError / noiseDn };
}

} // namespace sensornoise
