// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_IntensityIndex_h
#define sensornoise_base_IntensityIndex_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

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
