// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Quantiles_h
#define sensornoise_base_Quantiles_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sensornoise
{

/** The lowest and the highest of some values, and their number. */
struct ValueRange
{
  double      lowest{ std::numeric_limits<double>::infinity() };
  double      highest{ -std::numeric_limits<double>::infinity() };
  std::size_t values{ 0 };

  void
  Add(double value)
  {
    this->Add(ValueRange{ value, value, 1 });
  }
  void
  Add(const ValueRange & other)
  {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
    values += other.values;
  }
};

/** Returns the range of value(pixel) over the pixels below \a count for which has(pixel) is true. */
template <typename THas, typename TValue>
ValueRange
RangeOverPixels(std::size_t count, const ParallelFor & parallelFor, THas has, TValue value)
{
  ValueRange range;
  for (const ValueRange & part :
       PartsOfBlocks<ValueRange>(count, parallelFor, [&](std::size_t begin, std::size_t end, ValueRange & own) {
         for (std::size_t p = begin; p < end; ++p)
         {
           if (has(p))
           {
             own.Add(value(p));
           }
         }
       }))
  {
    range.Add(part);
  }
  return range;
}

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

/** Returns the number of the rising \a edges that fulfil \a isBefore, as the first edges do. The branches of
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

/** \class IntensityIndex
 * \brief Finds quantiles, neighbours in intensity and bins of equal count among the pixels of a mask without sorting.
 *
 * A histogram of 65,536 cells between the lowest and the highest mean reduces each search to a few cells, whose pixels
 * are then ordered exactly. Only the bins of equal count are accurate to one cell. The maps and the mask must outlive
 * the index and must not change. */
class SensorNoise_EXPORT IntensityIndex
{
public:
  IntensityIndex(const double *       mean,
                 const std::uint8_t * mask,
                 std::size_t          pixels,
                 const ParallelFor &  parallelFor = SerialFor);

  /** Number of pixels of the mask. */
  std::size_t
  Count() const
  {
    return m_Cumulative[Cells];
  }

  /** Returns the quantile \a q (0 to 1) of the mean [DN]. Throws std::invalid_argument if the mask is empty. */
  double
  QuantileDn(double q, const ParallelFor & parallelFor = SerialFor) const;

  /** Returns the distance from \a levelDn within which the \a count nearest pixels lie [DN]. */
  double
  ReachDn(double levelDn, std::size_t count) const;

  /** \class Bins
   * \brief Intensity bins of equal count, made of whole cells. */
  class SensorNoise_EXPORT Bins
  {
  public:
    Bins(const IntensityIndex & index, std::size_t bins);

    /** Returns the number of the bin that contains a pixel of mean \a meanDn. */
    std::size_t
    Of(double meanDn) const
    {
      return m_OfCell[m_Index.CellOf(meanDn)];
    }

  private:
    const IntensityIndex &     m_Index;
    std::vector<std::uint16_t> m_OfCell;
  };

private:
  static constexpr std::size_t Cells = 65536;

  std::size_t
  CellOf(double meanDn) const
  {
    const double cell = (meanDn - m_Lowest) * m_CellsPerDn;
    return cell <= 0.0 ? 0 : std::min(Cells - 1, static_cast<std::size_t>(cell));
  }
  std::size_t
  CellOfRank(std::size_t rank) const;
  std::size_t
  CountBetween(std::size_t centre, std::size_t margin) const;

  const double *           m_Mean;
  const std::uint8_t *     m_Mask;
  std::size_t              m_Pixels;
  double                   m_Lowest;
  double                   m_CellsPerDn;
  std::vector<std::size_t> m_Cumulative; // number of pixels below each cell
};

} // namespace sensornoise

#endif
