// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/FrameSums.h"

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/WideVectors.h"
#include "sensornoise/series/InstrumentRun.h"
#include "sensornoise/series/RegressorBand.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace sensornoise
{

namespace
{
using WeightedColumns = FrameRegressors::WeightedColumns;
using ClassColumns = std::array<WeightedColumns, GradientClasses>;

constexpr std::size_t BandPixels = 4096;    // the band's columns stay in the second-level cache
constexpr std::size_t FramesOfABatch = 128; // bounds the memory of the parts

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

/** Adds the sums of \a count series over a band to theirs over the classes, and calls function(cell of the band,
 * series, sum of w, sum of w I) for the cells, group by group. */
template <typename TFunction>
void
AddToClasses(const RegressorBand &                    band,
             const std::vector<RegressorBand::Sums> & sums,
             std::size_t                              count,
             ClassColumns *                           parts,
             TFunction                                function)
{
  for (std::size_t g = 0; g < sums.size(); ++g)
  {
    const RegressorBand::Group & group = band.GetGroups()[g];
    for (std::size_t k = 0; k < count; ++k)
    {
      const double * const sum = sums[g][k].data();
      WeightedColumns &    columns = parts[k][group.gradientClass];
      std::transform(columns.begin(), columns.end(), sum, columns.begin(), std::plus<double>());
      function(
        group.cell, k, sum[FrameColumns + FrameSums::Instruments], sum[FrameColumns + FrameSums::Instruments + 1]);
    }
  }
}
} // namespace

FrameSums::FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor)
  : m_Regressors(std::move(regressors))
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
  if (!m_HasColumns) // no frame has been added here
  {
    std::vector<ColumnSums> columns = this->StartColumns();
    parallelFor(m_CellRows, [&](std::size_t cellRow) {
      RegressorBand band(m_Regressors, m_CellsPerRow);
      ForBands(this->GetFrame().geometry, cellRow, m_CellRows, band, [&] {
        this->AddColumns(band, cellRow, columns[cellRow]);
      });
    });
    this->TakeColumns(columns);
  }
  m_Regressors.ReleaseInstruments();
}

template <typename TPixel>
void
FrameSums::AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
{
  for (std::size_t begin = 0; begin < count; begin += FramesOfABatch)
  {
    const std::size_t size = std::min(FramesOfABatch, count - begin);
    this->AddBatch(frames + begin * this->GetFrame().mean.size(), first + begin, size, parallelFor);
  }
}

/** For every cell row, unless they are there already. */
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

/** What needs no frame: a band's weighted columns times the columns' own values. */
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
    AddToClasses(band,
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

/** Noise is a line of the level: sums with 1 and with the level give what any line does to the instruments. */
void
FrameSums::SumInstruments(const ParallelFor & parallelFor)
{
  const auto sums = SumBlocks<2 * InstrumentRun::Terms>(
    this->GetFrame().mean.size(), parallelFor, [this](std::size_t begin, std::size_t end, auto & total) {
      InstrumentRun run{};
      for (std::size_t first = begin; first < end; first += InstrumentRun::Pixels)
      {
        WithWideVectors([&, last = std::min(end, first + InstrumentRun::Pixels)] {
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

template <typename TPixel>
void
FrameSums::AddBatch(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
{
  std::vector<std::vector<ClassColumns>> parts(m_CellRows, std::vector<ClassColumns>(count));
  std::vector<ColumnSums>                ofColumns = this->StartColumns();
  parallelFor(m_CellRows, [&](std::size_t cellRow) {
    RegressorBand band(m_Regressors, m_CellsPerRow);
    ForBands(this->GetFrame().geometry, cellRow, m_CellRows, band, [&] {
      if (!ofColumns.empty()) // the band need not be made again for them
      {
        this->AddColumns(band, cellRow, ofColumns[cellRow]);
      }
      const double * const mean = this->GetFrame().mean.data() + band.First();
      for (std::size_t t = 0; t < count; t += RegressorBand::Together)
      {
        const std::size_t together = std::min(RegressorBand::Together, count - t);
        for (std::size_t k = 0; k < together; ++k)
        {
          const TPixel * const frame = frames + (t + k) * this->GetFrame().mean.size() + band.First();
          double * const       series = band.Series(k);
          WithWideVectors([&] {
            std::transform(frame, frame + band.Pixels(), mean, series, [](TPixel value, double expected) {
              return static_cast<double>(value) - expected;
            });
          });
        }
        AddToClasses(band,
                     band.Multiply(),
                     together,
                     &parts[cellRow][t],
                     [&](std::size_t cell, std::size_t k, double w, double wI) {
                       std::array<double, 2> & ofCell =
                         m_Products.OfCell(first + t + k, cellRow * m_CellsPerRow + cell);
                       ofCell[0] += w;
                       ofCell[1] += wI;
                     });
      }
    });
  });
  if (!ofColumns.empty())
  {
    this->TakeColumns(ofColumns);
  }
  for (const std::vector<ClassColumns> & part : parts)
  {
    for (std::size_t t = 0; t < count; ++t)
    {
      for (std::size_t c = 0; c < GradientClasses; ++c)
      {
        const WeightedColumns & columns = part[t][c];
        m_Products.OfClass(first + t, c) += Eigen::Map<const ColumnVector>(columns.data());
        m_Products.OfInstruments(first + t)[0] += columns[FrameColumns];
        m_Products.OfInstruments(first + t)[1] += columns[FrameColumns + 1];
      }
    }
  }
}

template SensorNoise_EXPORT void
FrameSums::AddFrames(const unsigned char *, std::size_t, std::size_t, const ParallelFor &);
template SensorNoise_EXPORT void
FrameSums::AddFrames(const unsigned short *, std::size_t, std::size_t, const ParallelFor &);
template SensorNoise_EXPORT void
FrameSums::AddFrames(const short *, std::size_t, std::size_t, const ParallelFor &);
template SensorNoise_EXPORT void
FrameSums::AddFrames(const float *, std::size_t, std::size_t, const ParallelFor &);
template SensorNoise_EXPORT void
FrameSums::AddFrames(const double *, std::size_t, std::size_t, const ParallelFor &);

} // namespace sensornoise
