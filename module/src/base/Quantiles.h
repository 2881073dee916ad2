// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Quantiles_h
#define sensornoise_base_Quantiles_h

#include "SensorNoiseExport.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Returns the quantile \a q (0 to 1) of \a values, linear between order statistics. Reorders \a values. Throws
 * std::invalid_argument if there is none. */
SensorNoise_EXPORT double
Quantile(std::vector<double> & values, double q);

/** Returns the quantile as Quantile() does, and leaves the order of the values unchanged. */
SensorNoise_EXPORT double
QuantileOf(std::vector<double> values, double q);

/** Returns the quantile as Quantile() does, for values in rising order. */
SensorNoise_EXPORT double
SortedQuantile(const std::vector<double> & sorted, double q);

/** Median of the absolute value of a normal number of standard deviation 1. */
inline constexpr double MedianOfNormal = 0.6745;

/** Median of values, and their standard deviation estimated from the median absolute deviation, for normal values. */
struct RobustCentre
{
  double median{ 0.0 };
  double sd{ 0.0 };
};
SensorNoise_EXPORT RobustCentre
CentreOf(std::vector<double> values);

/** Returns the index at which the shortest interval of the \a sorted values begins that contains half of them, (n + 1)
 * / 2 of n. */
SensorNoise_EXPORT std::size_t
FindDensestHalf(const std::vector<double> & sorted);

/** Returns pixels for quantiles and rough fits: all of the mask, or evenly spaced ones of a large frame, fewer than
 * twice \a most. */
SensorNoise_EXPORT std::vector<std::size_t>
SamplePixels(const std::uint8_t * mask, std::size_t pixels, std::size_t most = 32768);
inline std::vector<std::size_t>
SamplePixels(const std::vector<std::uint8_t> & mask)
{
  return SamplePixels(mask.data(), mask.size());
}

/** Returns the median of the values of each of \a bins; NaN where a bin is empty. */
SensorNoise_EXPORT std::vector<double>
MediansOfBins(const std::vector<double> & values, const std::vector<std::size_t> & binOf, std::size_t bins);

/** Returns the edges between bins of equal count. They are slightly below a value, so that rounding does not separate
 * equal values. */
SensorNoise_EXPORT std::vector<double>
EdgesOfEqualCount(std::vector<double> values, std::size_t bins);

/** Returns the number of the rising \a edges that fulfil \a isBefore, as the first ones do. The branches of
 * std::partition_point() are unpredictable, and each misprediction takes longer than this whole search. */
template <typename TPredicate>
std::size_t
CountEdges(const std::vector<double> & edges, TPredicate isBefore)
{
  const double * first = edges.data();
  std::size_t    size = edges.size();
  while (size > 1)
  {
    const std::size_t half = size / 2;
    first += static_cast<std::size_t>(isBefore(first[half - 1])) * half;
    size -= half;
  }
  return static_cast<std::size_t>(first - edges.data()) + (size == 1 && isBefore(*first) ? 1 : 0);
}

/** Returns the number of the bin between \a edges in which a value lies. */
inline std::size_t
BinOf(const std::vector<double> & edges, double value)
{
  return CountEdges(edges, [value](double edge) { return !(value < edge); });
}

/** Returns the bin of each value, for bins of equal count. */
SensorNoise_EXPORT std::vector<std::size_t>
BinsOfEqualCount(const std::vector<double> & values, std::size_t bins);

} // namespace sensornoise

#endif
