// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FixedPatternEstimate.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Number of groups into which the pixels beside a boundary are divided. */
constexpr std::size_t Groups = 16;
/** Number of boundaries whose steps are compared, at least: their median size is then known to 30 %. */
constexpr std::size_t FewestBoundaries = 16;

/** Sums over the pairs of pixels on either side of each boundary between two columns or two rows, for each group. */
struct BoundarySums
{
  std::size_t         boundaries;
  std::vector<double> differences; ///< sums of the differences of the levels [DN]
  std::vector<double> signals;     ///< sums of the mean signals [DN]
  std::vector<double> pairs;       ///< numbers of pairs

  explicit BoundarySums(std::size_t count)
    : boundaries(count)
    , differences(Groups * count)
    , signals(Groups * count)
    , pairs(Groups * count)
  {}

  /** Adds the pair of pixels \a p and \a after. */
  void
  Add(const VarianceData & data, double blackDn, std::size_t p, std::size_t after, std::size_t at)
  {
    if (data.mask[p] != 0 && data.mask[after] != 0)
    {
      differences[at] += data.mean[after] - data.mean[p];
      signals[at] += 0.5 * (data.mean[after] + data.mean[p]) - blackDn;
      pairs[at] += 1.0;
    }
  }
  /** Returns the sum of \a values over the groups of a boundary. */
  double
  Total(const std::vector<double> & values, std::size_t boundary) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < Groups; ++k)
    {
      sum += values[k * boundaries + boundary];
    }
    return sum;
  }
};

BoundarySums
SumColumns(const VarianceData & data, const FrameGeometry & geometry, double blackDn, const ParallelFor & parallelFor)
{
  BoundarySums sums(geometry.width - 1);
  parallelFor(Groups, [&](std::size_t k) {
    for (std::size_t y = k * geometry.height / Groups; y < (k + 1) * geometry.height / Groups; ++y)
    {
      for (std::size_t x = 0; x + 1 < geometry.width; ++x)
      {
        const std::size_t p = y * geometry.width + x;
        sums.Add(data, blackDn, p, p + 1, k * sums.boundaries + x);
      }
    }
  });
  return sums;
}

BoundarySums
SumRows(const VarianceData & data, const FrameGeometry & geometry, double blackDn, const ParallelFor & parallelFor)
{
  BoundarySums sums(geometry.height - 1);
  parallelFor(sums.boundaries, [&](std::size_t y) {
    for (std::size_t x = 0; x < geometry.width; ++x)
    {
      const std::size_t p = y * geometry.width + x;
      sums.Add(data, blackDn, p, p + geometry.width, x * Groups / geometry.width * sums.boundaries + y);
    }
  });
  return sums;
}

/** A step of the levels along a whole boundary. */
struct SensorStep
{
  std::size_t boundary; ///< the last column or row before the step
  double      size;     ///< relative to the signal [1]
};

/** Returns the step that no other boundary has, of boundaries with \a across pairs of pixels each. Null: there is none.
 */
std::optional<SensorStep>
FindStep(const BoundarySums & sums, std::size_t across)
{
  const double             fewest = InPattern.leastPairs * static_cast<double>(across);
  std::vector<double>      steps;
  std::vector<std::size_t> known; // the boundaries of the steps
  for (std::size_t b = 0; b < sums.boundaries; ++b)
  {
    const double signal = sums.Total(sums.signals, b);
    if (signal > 0.0 && sums.Total(sums.pairs, b) > fewest)
    {
      steps.push_back(sums.Total(sums.differences, b) / signal);
      known.push_back(b);
    }
  }
  if (known.size() < FewestBoundaries)
  {
    return std::nullopt;
  }
  const double        usual = QuantileOf(steps, 0.5);
  std::vector<double> sizes;
  std::transform(
    steps.begin(), steps.end(), std::back_inserter(sizes), [usual](double own) { return std::abs(own - usual); });
  const auto   largest = std::max_element(sizes.begin(), sizes.end());
  const auto   place = static_cast<std::size_t>(largest - sizes.begin());
  const auto   boundary = known[place];
  const double size = *largest;
  *largest = 0.0;
  const double chance = Significance.manyTests * QuantileOf(sizes, 0.5) / MedianOfNormal;
  const double others = *std::max_element(sizes.begin(), sizes.end());
  if (!(size > chance && size > 2.0 * others && size < InPattern.largestStep))
  {
    return std::nullopt;
  }
  const double        step = steps[place] - usual;
  std::vector<double> fractions; // each group's part of the step
  for (std::size_t k = 0; k < Groups; ++k)
  {
    const std::size_t at = k * sums.boundaries + boundary;
    if (sums.signals[at] > 0.0)
    {
      fractions.push_back((sums.differences[at] / sums.signals[at] - usual) / step);
    }
  }
  const bool isEverywhere = QuantileOf(fractions, 0.25) > 0.0 && QuantileOf(fractions, 0.5) > 0.5;
  return isEverywhere ? std::optional<SensorStep>(SensorStep{ boundary, step }) : std::nullopt;
}
} // namespace

double
FractionOfSensorSteps(const VarianceData &  data,
                      const FrameGeometry & geometry,
                      const VarianceLine &  line,
                      double                blackDn,
                      double                levelVarianceDn2,
                      const ParallelFor &   parallelFor)
{
  const auto ofColumns = FindStep(SumColumns(data, geometry, blackDn, parallelFor), geometry.height);
  const auto ofRows = FindStep(SumRows(data, geometry, blackDn, parallelFor), geometry.width);
  if (!ofColumns && !ofRows)
  {
    return 0.0;
  }
  double w = 0.0;
  double levels = 0.0;
  double patterns = 0.0;
  double products = 0.0;
  for (std::size_t p = 0; p < data.pixels; ++p)
  {
    if (data.mask[p] != 0)
    {
      const double variance = line.At(data.neighbourMean[p]);
      const double weight = 1.0 / (variance * variance);
      const double x = data.mean[p] - line.pivotDn;
      const bool   isBehindColumn = ofColumns && p % geometry.width > ofColumns->boundary;
      const bool   isBehindRow = ofRows && p / geometry.width > ofRows->boundary;
      const double relative = (isBehindColumn ? ofColumns->size : 0.0) + (isBehindRow ? ofRows->size : 0.0);
      const double pattern = relative * (data.mean[p] - blackDn);
      w += weight;
      levels += weight * x;
      patterns += weight * pattern;
      products += weight * pattern * x;
    }
  }
  const double covariance = std::abs(products - patterns * levels / w) / w;
  return covariance < levelVarianceDn2 ? covariance / levelVarianceDn2 : 1.0;
}

} // namespace sensornoise
