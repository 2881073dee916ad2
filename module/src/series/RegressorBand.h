// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_RegressorBand_h
#define sensornoise_series_RegressorBand_h

#include "SensorNoiseExport.h"
#include "base/Simd.h"
#include "series/FrameRegressors.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace sensornoise
{

/** The weighted columns of a pixel in single precision, and padding. */
using SingleColumns = std::array<float, std::tuple_size_v<FrameRegressors::WeightedColumns>>;

/** Sums of one group of pixels: sums[series][column]. */
using GroupSums = std::array<FrameRegressors::WeightedColumns, FramesTogether>;

/** Number of pixels whose products are summed in single precision, before the sum is added in double precision.
 * Rounding changes the sum of 256 products of noise by 1e-7 of its standard deviation. Estimator.md, 6. */
inline constexpr std::size_t PixelsOfSingleSum = 256;

/** Factors of the products that are summed over a group of pixels. */
struct GroupFactors
{
  const SingleColumns * columns; ///< columns of the pixels, group by group
  const std::uint32_t * order;   ///< places of the pixels in a series
  const float *         series;  ///< FramesTogether series
  std::size_t           pixels;  ///< distance from one series to the next
  std::size_t           begin;   ///< first pixel of the group
  std::size_t           end;     ///< pixel after the last pixel
};

/** Computes the sums over the pixels of a group of their columns times the values of the series, with the SIMD
 * instructions of the processor. PixelsOfSingleSum products are summed in single precision. The bits are the same on
 * all processors. */
SensorNoise_EXPORT void
MultiplyGroup(const GroupFactors & of, GroupSums & sums);

/** Computes the sums as MultiplyGroup() does, by loops for any processor. */
SensorNoise_EXPORT void
MultiplyGroupAnywhere(const GroupFactors & of, GroupSums & sums);

/** \class RegressorBand
 * \brief The weighted columns of FrameRegressors over a few rows of the image, ordered by cell and class, and their
 * inner products with series.
 *
 * Whole rows are read from memory in one piece. The columns stay in the second-level cache while all frames are
 * processed, and the sums of one group in registers. Columns and series have single precision. A band is moved from
 * rows to rows, so that its memory is allocated once. */
class SensorNoise_EXPORT RegressorBand
{
public:
  static constexpr std::size_t Together = FramesTogether; // number of series whose sums stay in registers

  /** Sums of one group: sums[series][column]. */
  using Sums = GroupSums;

  /** The pixels of one class in one cell of the band. */
  struct Group
  {
    std::size_t cell;
    std::size_t gradientClass;
    std::size_t begin;
    std::size_t end;
  };

  /** Divides the image into \a cells cells side by side. \a regressors must outlive the object. */
  RegressorBand(const FrameRegressors & regressors, std::size_t cells);

  /** Moves the band to the rows \a firstRow ... \a firstRow + \a rows - 1 of the image. */
  void
  MoveTo(std::size_t firstRow, std::size_t rows);

  /** Pixels of the band: First() ... First() + Pixels() - 1. */
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
  /** Returns the used pixels, counted from First() and ordered by group. */
  const std::vector<std::uint32_t> &
  GetOrder() const
  {
    return m_Order;
  }

  /** Returns the unit of the series: a power of 2 near the standard deviation of the noise [DN]. In this unit the
   * factors are far from the limits of single precision, whatever the digital numbers are. */
  double
  UnitDn() const
  {
    return m_UnitDn;
  }
  /** Memory for the values of series \a k of Together at all pixels of the band, in UnitDn(), to be filled before
   * Multiply(). */
  float *
  Series(std::size_t k)
  {
    return m_Series.data() + k * m_Stride;
  }
  /** Computes the sums over the pixels of every group of their columns times the values of the series. The result is
   * valid until the next call. The bits of a series do not depend on the other series. Calls meanwhile(g) before each
   * group g. */
  template <typename TFunction>
  const std::vector<Sums> &
  Multiply(TFunction meanwhile)
  {
    for (std::size_t g = 0; g < m_Groups.size(); ++g)
    {
      meanwhile(g);
      this->MultiplyGroupBy(g);
    }
    return m_Sums;
  }
  /** Computes the sums as Multiply() does, in double precision, with the values of the columns from \a first on as the
   * Together series. The sums behind the last column have no meaning. */
  const std::vector<Sums> &
  MultiplyByValues(std::size_t first);

private:
  /** Rows of numbers of the pixels, each kind separately for SIMD: the values of the columns, followed by these. */
  enum Row : std::size_t
  {
    InstrumentX = FrameColumns,
    InstrumentY,
    Weight,
    CellWeight,
    NumberOfRows
  };
  static_assert(NumberOfRows >= (FrameColumns + Together - 1) / Together * Together, "MultiplyByValues() stays inside");

  /** Numbers between two rows: a line of the cache. The lines of rows that lie a power of 2 apart would displace each
   * other. */
  static constexpr std::size_t Gap = 16;

  float *
  RowOf(std::size_t kind)
  {
    return m_Rows.data() + kind * m_Stride;
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
  MultiplyGroupBy(std::size_t group);

  const FrameRegressors &    m_Regressors;
  std::size_t                m_Cells;
  double                     m_UnitDn;
  std::size_t                m_First{ 0 };
  std::size_t                m_Pixels{ 0 };
  std::size_t                m_Stride{ 0 }; // from one row of numbers, or one series, to the next
  std::vector<std::size_t>   m_Places;
  std::vector<Group>         m_Groups;
  std::vector<std::uint32_t> m_Order;
  std::vector<SingleColumns> m_Columns; // in units of 1 / UnitDn()
  std::vector<float>         m_Rows;    // in UnitDn(), the weights in 1 / UnitDn()^2
  std::vector<float>         m_Series;
  std::vector<Sums>          m_Sums;
};

} // namespace sensornoise

#endif
