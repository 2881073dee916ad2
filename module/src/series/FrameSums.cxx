// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameSums.h"

#include "sensornoise/FrameGeometry.h"
#include "base/Avx2.h"
#include "series/FrameBatch.h"
#include "series/InstrumentRun.h"
#include "series/RegressorBand.h"

#include <algorithm>
#include <utility>

namespace sensornoise
{

namespace
{
/** Size of the sums of a plane, by rows of cells, over the frames that are added together [bytes]: 170 frames of 512
 * rows or more. The columns of a plane are computed again for every batch, which takes as long as a dozen frames.
 * Chosen empirically: half makes two batches of 100 frames; twice as much makes one batch of 200 and takes 4 MiB more.
 */
constexpr std::size_t BytesOfBatch = std::size_t{ 4 } << 20;
} // namespace

FrameSums::FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor)
  : m_Regressors(std::move(regressors))
  , m_Layout(PixelLayout::OfFrames(this->GetFrame().geometry))
  , m_CellRows(std::clamp<std::size_t>(this->GetFrame().geometry.height / 8, 1, 64))
  , m_CellsPerRow(std::clamp<std::size_t>(this->GetFrame().geometry.width / 32, 1, 16))
  , m_Products(this->GetFrame().mean.size(), this->GetFrame().frames, m_CellRows * m_CellsPerRow)
  , m_ClassGram(GradientClasses, ClassMatrix::Zero())
  , m_InstrumentGram(Eigen::Matrix<double, Instruments, FrameColumns>::Zero())
{
  this->SumInstruments(parallelFor);
}

void
FrameSums::EndFrames(const ParallelFor & parallelFor)
{
  if (!m_HasColumns) // no frame has been added in this process
  {
    std::vector<ColumnSums> columns = this->StartColumns();
    parallelFor(m_CellRows, [&](std::size_t cellRow) {
      RegressorBand band(m_Regressors, m_CellsPerRow);
      detail::ForBands(this->GetFrame().geometry, cellRow, m_CellRows, band, [&] {
        this->AddColumns(band, cellRow, columns[cellRow]);
      });
    });
    this->TakeColumns(columns);
  }
  m_Regressors.ReleaseInstruments();
}

template <typename TPixel>
void
FrameSums::AddFrames(const std::vector<Plane> & planes,
                     const TPixel *             frames,
                     std::size_t                count,
                     const ParallelFor &        parallelFor)
{
  const std::size_t cellRows = planes.front().sums->m_CellRows;
  const std::size_t together =
    std::max(RegressorBand::Together, BytesOfBatch / (cellRows * sizeof(detail::ClassColumns)));
  for (std::size_t begin = 0; begin < count; begin += together)
  {
    std::vector<Batch<TPixel>> batches;
    for (const Plane & plane : planes)
    {
      FrameSums & sums = *plane.sums;
      batches.push_back({ &sums,
                          frames + begin * sums.m_Layout.frame,
                          plane.first + begin,
                          std::min(together, count - begin),
                          std::vector<std::vector<detail::ClassColumns>>(cellRows),
                          sums.StartColumns() });
    }
    parallelFor(cellRows, [&](std::size_t cellRow) {
      for (Batch<TPixel> & batch : batches)
      {
        batch.AddCellRow(cellRow);
      }
    });
    for (Batch<TPixel> & batch : batches)
    {
      batch.End();
    }
  }
}

/** Returns empty sums for every row of cells; an empty list if the columns are known already. */
std::vector<FrameSums::ColumnSums>
FrameSums::StartColumns()
{
  if (m_HasColumns)
  {
    return {};
  }
  m_Cells.assign(m_CellRows * m_CellsPerRow, Cell());
  return std::vector<ColumnSums>(m_CellRows);
}

/** Adds the sums that need no frame: the weighted columns of a band times the values of the columns. */
void
FrameSums::AddColumns(RegressorBand & band, std::size_t cellRow, ColumnSums & columns)
{
  Cell * const cells = m_Cells.data() + cellRow * m_CellsPerRow;
  for (const RegressorBand::Group & group : band.GetGroups())
  {
    cells[group.cell].pixels += group.end - group.begin;
  }
  for (std::size_t first = 0; first < FrameColumns; first += RegressorBand::Together)
  {
    detail::AddToClasses(band,
                         band.MultiplyByValues(first),
                         std::min(RegressorBand::Together, FrameColumns - first),
                         &columns[first],
                         [&](std::size_t cell, std::size_t k, double w, double wI) {
                           cells[cell].sum[first + k] += w;
                           cells[cell].sumI[first + k] += wI;
                         });
  }
}

void
FrameSums::TakeColumns(const std::vector<ColumnSums> & ofCellRows)
{
  for (const ColumnSums & columns : ofCellRows)
  {
    for (std::size_t k = 0; k < FrameColumns; ++k)
    {
      const auto column = static_cast<Eigen::Index>(k);
      for (std::size_t c = 0; c < GradientClasses; ++c)
      {
        m_ClassGram[c].col(column) += Eigen::Map<const ColumnVector>(columns[k][c].data());
        m_InstrumentGram.col(column) += Eigen::Map<const Eigen::Vector2d>(columns[k][c].data() + FrameColumns);
      }
    }
  }
  m_HasColumns = true;
}

/** Computes the noise of the instruments. The variance is a linear function of the level: the sums with 1 and with the
 * level yield it for any line. */
void
FrameSums::SumInstruments(const ParallelFor & parallelFor)
{
  const auto sums = SumBlocks<2 * InstrumentRun::Terms>(
    this->GetFrame().mean.size(), parallelFor, [this](std::size_t begin, std::size_t end, auto & total) {
      InstrumentRun run{};
      for (std::size_t first = begin; first < end; first += InstrumentRun::Pixels)
      {
        CallWithAvx2([&, last = std::min(end, first + InstrumentRun::Pixels)] {
          run.Fill(m_Regressors, first, last);
          run.AddTo(total);
        });
      }
    });
  m_OfOne.variance = sums[0];
  m_OfOne.squares << sums[1], sums[2], sums[2], sums[3];
  m_OfLevel.variance = sums[4];
  m_OfLevel.squares << sums[5], sums[6], sums[6], sums[7];
}

#define SensorNoise_INSTANTIATE(TPixel)                  \
  template SensorNoise_EXPORT void FrameSums::AddFrames( \
    const std::vector<Plane> &, const TPixel *, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
