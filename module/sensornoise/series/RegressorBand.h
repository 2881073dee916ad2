// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_RegressorBand_h
#define sensornoise_series_RegressorBand_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/series/FrameRegressors.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class RegressorBand
 * \brief The weighted columns of FrameRegressors over a few rows of the image, ordered by cell and class, and their
 * inner products with series.
 *
 * Whole rows are read from memory in one piece; the columns stay in the second-level cache while all frames pass, and
 * the sums of one group in registers. */
class SensorNoise_EXPORT RegressorBand
{
public:
  static constexpr std::size_t Together = 4; // series whose sums stay in registers

  using Vector = Eigen::Matrix<double, Together, 1>; // the values of series at a pixel
  using Sums = Eigen::Matrix<double, FrameRegressors::WeightedColumns{}.size(), Together>;

  /** The pixels of one class in one cell of the band. */
  struct Group
  {
    std::size_t cell;
    std::size_t gradientClass;
    std::size_t begin;
    std::size_t end;
  };

  /** The rows \a firstRow ... \a firstRow + \a rows - 1 of the image, cut into \a cells cells side by side. */
  RegressorBand(const FrameRegressors & regressors, std::size_t firstRow, std::size_t rows, std::size_t cells);

  /** The band's pixels are First() ... First() + Pixels() - 1. */
  std::size_t
  First() const
  {
    return m_First;
  }
  std::size_t
  Pixels() const
  {
    return m_Pixels;
  }
  const std::vector<Group> &
  GetGroups() const
  {
    return m_Groups;
  }
  /** The pixels that serve, counted from First() and ordered by group. */
  const std::vector<std::uint32_t> &
  GetOrder() const
  {
    return m_Order;
  }

  /** Fills \a sums with those over the pixels of every group of their columns times \a values, which are the values of
   * Together series at all pixels of the band. A series' bits do not depend on those beside it. */
  void
  Multiply(const std::vector<Vector> & values, std::vector<Sums> & sums) const;

private:
  std::size_t                                   m_First;
  std::size_t                                   m_Pixels;
  std::vector<Group>                            m_Groups;
  std::vector<std::uint32_t>                    m_Order;
  std::vector<FrameRegressors::WeightedColumns> m_Columns;
};

} // namespace sensornoise

#endif
