// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"

#include "moments/Constants.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

std::vector<std::size_t>
AllBelow(std::size_t count)
{
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{ 0 });
  return all;
}

FrameFit
FitCells(const std::vector<double> & mean, const std::vector<double> & frame, const std::vector<std::size_t> & used)
{
  const auto count = static_cast<double>(used.size());
  FrameFit   fit;
  for (const std::size_t i : used)
  {
    fit.centre += mean[i];
    fit.level += frame[i];
  }
  fit.centre /= count;
  fit.level /= count;
  double ofMean = 0.0;
  double ofFrame = 0.0;
  double ofBoth = 0.0;
  for (const std::size_t i : used)
  {
    ofMean += (mean[i] - fit.centre) * (mean[i] - fit.centre);
    ofFrame += (frame[i] - fit.level) * (frame[i] - fit.level);
    ofBoth += (mean[i] - fit.centre) * (frame[i] - fit.level);
  }
  fit.factor = ofMean > 0.0 ? ofBoth / ofMean : 0.0;
  fit.meanSquare = std::max(0.0, ofFrame - fit.factor * ofBoth) / count;
  return fit;
}

FrameFit
FitMostCells(const std::vector<double> & mean, const std::vector<double> & frame)
{
  std::vector<std::size_t> cells = AllBelow(mean.size());
  const FrameFit           all = FitCells(mean, frame, cells);
  const auto               few = static_cast<std::ptrdiff_t>(InMoments.fewCells * static_cast<double>(cells.size()));
  const auto               difference = [&](std::size_t i) { return std::abs(all.DifferenceOf(mean[i], frame[i])); };
  std::nth_element(cells.begin(), cells.end() - 1 - few, cells.end(), [&](std::size_t a, std::size_t b) {
    return difference(a) < difference(b) || (!(difference(b) < difference(a)) && a < b);
  });
  cells.resize(cells.size() - static_cast<std::size_t>(few));
  std::sort(cells.begin(), cells.end()); // the same order of summation with every standard library
  return FitCells(mean, frame, cells);
}

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
  const double residual = std::max(0.0, all - explained);
  const double error = squares > 0.0 ? std::sqrt(residual / ((count - 2.0) * squares)) : 1.0;
  return { level, slope, error, explained > residual };
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
  double              largest = 0.0;
  double              levels = 0.0;
  std::vector<double> errors;
  for (const std::vector<double> & frame : frames)
  {
    const FrameDifference difference = CompareWithMean(mean, centre, squares, frame);
    if (difference.isExplained)
    {
      slopes += difference.slope * difference.slope;
      largest = std::max(largest, std::abs(difference.slope));
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
  const bool hasContrast = Quantile(errors, 0.5) < InMoments.strongIlluminationChange / Significance.oneTest;
  if (hasContrast)
  {
    const double ofOneFrame = InMoments.strongIlluminationChange * largest / InMoments.strongChangeOfOneFrame;
    return std::max(std::sqrt(slopes / dof), ofOneFrame);
  }
  const double strong = InMoments.strongChangeOfFlat * noiseDn2;
  return strong > 0.0 ? InMoments.strongIlluminationChange * std::sqrt(levels / dof / strong) : 0.0;
}

} // namespace sensornoise
