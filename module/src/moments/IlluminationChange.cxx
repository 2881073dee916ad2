// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/IlluminationChange.h"

#include "base/Quantiles.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

namespace
{
/** Difference between the cells of a frame and the cells of the mean frame: a level, a slope, and the rest. */
struct FrameDifference
{
  double level;      ///< mean over the cells [DN]
  double slope;      ///< relative change about the mean over the cells [1]
  double slopeError; ///< standard error of the slope, from the unexplained difference [1]
  bool   isExplained;
};

FrameDifference
CompareWithMean(const std::vector<double> & mean, double centre, double squares, const std::vector<double> & frame)
{
  const auto count = static_cast<double>(mean.size());
  double     sum = 0.0;
  double     products = 0.0;
  double     all = 0.0;
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    const double difference = frame[i] - mean[i];
    sum += difference;
    products += difference * (mean[i] - centre);
    all += difference * difference;
  }
  const double level = sum / count;
  const double slope = squares > 0.0 ? products / squares : 0.0;
  const double explained = count * level * level + slope * products;
  const double unexplained = std::max(0.0, all - explained);
  const double error = squares > 0.0 ? std::sqrt(unexplained / ((count - 2.0) * squares)) : 1.0;
  return { level, slope, error, explained > unexplained };
}
} // namespace

double
ComputeIlluminationChange(const std::vector<double> &              mean,
                          const std::vector<std::vector<double>> & frames,
                          double                                   noiseDn2)
{
  const double centre = std::accumulate(mean.begin(), mean.end(), 0.0) / static_cast<double>(mean.size());
  const double squares = std::accumulate(
    mean.begin(), mean.end(), 0.0, [centre](double sum, double own) { return sum + (own - centre) * (own - centre); });
  double              slopes = 0.0;
  double              levels = 0.0;
  std::vector<double> errors;
  for (const std::vector<double> & frame : frames)
  {
    const FrameDifference difference = CompareWithMean(mean, centre, squares, frame);
    if (difference.isExplained)
    {
      slopes += difference.slope * difference.slope;
      levels += difference.level * difference.level;
      errors.push_back(difference.slopeError);
    }
  }
  if (errors.empty())
  {
    return 0.0;
  }
  // The differences from the mean frame have the mean 0 over all frames.
  const auto dof = static_cast<double>(frames.size() - 1);
  const bool hasContrast = Quantile(errors, 0.5) < InMoments.largestSlopeError * InMoments.strongIlluminationChange;
  if (hasContrast)
  {
    return std::sqrt(slopes / dof);
  }
  const double strong = InMoments.strongChangeOfFlat * noiseDn2;
  return strong > 0.0 ? InMoments.strongIlluminationChange * std::sqrt(levels / dof / strong) : 0.0;
}

} // namespace sensornoise
