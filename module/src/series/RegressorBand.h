// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_RegressorBand_h
#define sensornoise_series_RegressorBand_h

#include "SensorNoiseExport.h"
#include "base/FramesTogether.h"
#include "series/FrameRegressors.h"

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
 * the sums of one group in registers. A band is moved from rows to rows, for its memory is made once. */
class SensorNoise_EXPORT RegressorBand
{
public:
  static constexpr std::size_t Together = FramesTogether; // series whose sums stay in registers

  /** Of one group: sums[series][column]. */
  using Sums = std::array<FrameRegressors::WeightedColumns, Together>;

  /** The pixels of one class in one cell of the band. */
  struct Group
  {
    std::size_t cell;
    std::size_t gradientClass;
    std::size_t begin;
    std::size_t end;
  };

  /** The image is cut into \a cells cells side by side. \a regressors must outlive the object. */
  RegressorBand(const FrameRegressors & regressors, std::size_t cells);

  /** The band becomes the rows \a firstRow ... \a firstRow + \a rows - 1 of the image. */
  void
  MoveTo(std::size_t firstRow, std::size_t rows);

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

  /** Where the values of series \a k of Together at all pixels of the band are to be put. */
  double *
  Series(std::size_t k)
  {
    return m_Series.data() + k * m_Pixels;
  }
  /** Sums over the pixels of every group of their columns times the values of the series, until the next call. A
   * series' bits do not depend on those beside it. Calls meanwhile(g) before each group g. */
  template <typename TFunction>
  const std::vector<Sums> &
  Multiply(TFunction meanwhile)
  {
    for (std::size_t g = 0; g < m_Groups.size(); ++g)
    {
      meanwhile(g);
      this->MultiplyGroupBy(g, m_Series.data());
    }
    return m_Sums;
  }
  /** The same where the series are Together of the pixels' own values from column \a first on; those behind the last
   * column are of no meaning. */
  const std::vector<Sums> &
  MultiplyByValues(std::size_t first)
  {
    for (std::size_t g = 0; g < m_Groups.size(); ++g)
    {
      this->MultiplyGroupBy(g, m_Rows.data() + first * m_Pixels);
    }
    return m_Sums;
  }

private:
  /** Numbers of the pixels, each kind in a row by itself, so that vectors make them: the columns' values, and behind
   * them these. */
  enum Row : std::size_t
  {
    InstrumentX = FrameColumns,
    InstrumentY,
    Weight,
    CellWeight,
    NumberOfRows
  };
  static_assert(NumberOfRows >= (FrameColumns + Together - 1) / Together * Together, "MultiplyByValues() stays inside");

  double *
  RowOf(std::size_t kind)
  {
    return m_Rows.data() + kind * m_Pixels;
  }
  template <typename TFunction>
  void
  ForUsed(TFunction function) const;
  void
  FindOrder();
  void
  FillValues();
  void
  FillWeights();
  void
  FillColumns();
  void
  MultiplyGroupBy(std::size_t group, const double * series);

  const FrameRegressors &                       m_Regressors;
  std::size_t                                   m_Cells;
  std::size_t                                   m_First{ 0 };
  std::size_t                                   m_Pixels{ 0 };
  std::vector<std::size_t>                      m_Places;
  std::vector<Group>                            m_Groups;
  std::vector<std::uint32_t>                    m_Order;
  std::vector<FrameRegressors::WeightedColumns> m_Columns;
  std::vector<double>                           m_Rows;
  std::vector<double>                           m_Series;
  std::vector<Sums>                             m_Sums;
};

} // namespace sensornoise

#endif
