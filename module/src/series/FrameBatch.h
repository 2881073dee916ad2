// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameBatch_h
#define sensornoise_series_FrameBatch_h

#include "sensornoise/FrameGeometry.h"
#include "base/PixelLayout.h"
#include "base/Simd.h"
#include "series/FrameSums.h"
#include "series/RegressorBand.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace sensornoise
{

namespace detail
{
using WeightedColumns = FrameRegressors::WeightedColumns;
using ClassColumns = std::array<WeightedColumns, GradientClasses>;

/** Sums over a row of cells for one frame: with the weighted columns by gradient class, and with the instruments for
 * the blocks side by side. */
struct RowSums
{
  ClassColumns                                                    ofClasses{};
  std::array<std::array<double, 2>, FrameProducts::BlocksPerAxis> ofInstruments{};
};

/** Sums over one group of pixels: with the instruments, and with 1 and the mean in the weights of cells. */
struct GroupColumns
{
  const double * ofInstruments;
  const double * ofCell;
};

inline constexpr std::size_t BandPixels = 4096; // size of a band: its columns stay in the second-level cache

/** Calls function() after \a band was moved to each band of a row of cells, in order. */
template <typename TFunction>
void
ForBands(const FrameGeometry & geometry,
         std::size_t           cellRow,
         std::size_t           cellRows,
         RegressorBand &       band,
         TFunction             function)
{
  const std::size_t end = geometry.height * (cellRow + 1) / cellRows;
  const std::size_t rows = std::max<std::size_t>(1, BandPixels / geometry.width);
  for (std::size_t y = geometry.height * cellRow / cellRows; y < end; y += rows)
  {
    band.MoveTo(y, std::min(rows, end - y));
    function();
  }
}

/** Adds the sums of \a count series over a band to the sums over the classes, classesOf(series). Calls function(cell of
 * the band, series, GroupColumns) group by group. */
template <typename TClasses, typename TFunction>
void
AddToClasses(const RegressorBand &                    band,
             const std::vector<RegressorBand::Sums> & sums,
             std::size_t                              count,
             TClasses                                 classesOf,
             TFunction                                function)
{
  for (std::size_t g = 0; g < sums.size(); ++g)
  {
    const RegressorBand::Group & group = band.GetGroups()[g];
    for (std::size_t k = 0; k < count; ++k)
    {
      const double * const sum = sums[g][k].data();
      WeightedColumns &    columns = classesOf(k)[group.gradientClass];
      std::transform(columns.begin(), columns.end(), sum, columns.begin(), std::plus<double>());
      function(group.cell, k, GroupColumns{ sum + FrameColumns, sum + FrameColumns + FrameSums::Instruments });
    }
  }
}
} // namespace detail

/** Frames that are being added to the sums. */
template <typename TPixel>
struct FrameSums::Batch
{
  FrameSums *                               sums{ nullptr };
  const TPixel *                            frames{ nullptr };
  std::size_t                               first{ 0 };
  std::size_t                               count{ 0 };
  std::vector<std::vector<detail::RowSums>> parts;     // sums of each row of cells and each frame
  std::vector<ColumnSums>                   ofColumns; // sums of each row of cells; empty: they are known

  /** Adds the sums over a row of cells. Different rows may be added at the same time. */
  void
  AddCellRow(std::size_t cellRow)
  {
    const PixelLayout & layout = sums->m_Layout;
    RegressorBand       band(sums->m_Regressors, sums->m_CellsPerRow);
    std::vector<TPixel> buffer;
    parts[cellRow].resize(count);
    detail::ForBands(sums->GetFrame().geometry, cellRow, sums->m_CellRows, band, [&] {
      buffer.resize(layout.AreSideBySide() ? 0 : band.Pixels());
      if (!ofColumns.empty()) // uses the same band, so that it need not be computed again
      {
        sums->AddColumns(band, cellRow, ofColumns[cellRow]);
      }
      const double * const mean = sums->GetFrame().mean.data() + band.First();
      for (std::size_t t = 0; t < count; t += RegressorBand::Together)
      {
        const std::size_t together = std::min(RegressorBand::Together, count - t);
        for (std::size_t k = 0; k < together; ++k)
        {
          const TPixel * const frame = layout.SideBySide(
            frames + (t + k) * layout.frame, band.First(), band.First() + band.Pixels(), buffer.data());
          float * const series = band.Series(k);
          CallWithAvx2([&, inverse = 1.0 / band.UnitDn()] {
            std::transform(frame, frame + band.Pixels(), mean, series, [inverse](TPixel value, double expected) {
              return static_cast<float>(inverse * (static_cast<double>(value) - expected));
            });
          });
        }
        detail::AddToClasses(
          band,
          band.Multiply([&, next = t + together](std::size_t group) { this->AskFor(band, group, next); }),
          together,
          [&](std::size_t k) -> detail::ClassColumns & { return parts[cellRow][t + k].ofClasses; },
          [&](std::size_t cell, std::size_t k, const detail::GroupColumns & sum) {
            std::array<double, 2> & ofCell =
              sums->m_Products.OfCell(first + t + k, cellRow * sums->m_CellsPerRow + cell);
            ofCell[0] += sum.ofCell[0];
            ofCell[1] += sum.ofCell[1];
            std::array<double, 2> & ofInstruments = parts[cellRow][t + k].ofInstruments[sums->BlockOfCell(cell)];
            ofInstruments[0] += sum.ofInstruments[0];
            ofInstruments[1] += sum.ofInstruments[1];
          });
      }
    });
  }

  /** Prefetches the pixels of the frames from \a next on, a part with every group. */
  void
  AskFor(const RegressorBand & band, std::size_t group, std::size_t next) const
  {
    const std::size_t groups = band.GetGroups().size();
    for (std::size_t t = next; t < std::min(count, next + RegressorBand::Together); ++t)
    {
      sums->m_Layout.Prefetch(frames + t * sums->m_Layout.frame,
                              band.First() + band.Pixels() * group / groups,
                              band.First() + band.Pixels() * (group + 1) / groups);
    }
  }

  /** Adds the sums of all rows of cells to the FrameSums. */
  void
  End()
  {
    if (!ofColumns.empty())
    {
      sums->TakeColumns(ofColumns);
    }
    for (std::size_t cellRow = 0; cellRow < parts.size(); ++cellRow)
    {
      const std::size_t block = sums->BlockOfRow(cellRow) * FrameProducts::BlocksPerAxis;
      for (std::size_t t = 0; t < count; ++t)
      {
        const detail::RowSums & row = parts[cellRow][t];
        for (std::size_t c = 0; c < GradientClasses; ++c)
        {
          sums->m_Products.OfClass(first + t, c) += Eigen::Map<const ColumnVector>(row.ofClasses[c].data());
        }
        for (std::size_t b = 0; b < FrameProducts::BlocksPerAxis; ++b)
        {
          std::array<double, 2> & ofBlock = sums->m_Products.OfInstruments(first + t, block + b);
          ofBlock[0] += row.ofInstruments[b][0];
          ofBlock[1] += row.ofInstruments[b][1];
        }
      }
    }
  }
};

} // namespace sensornoise

#endif
