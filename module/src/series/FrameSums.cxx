// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameSums.h"

#include "sensornoise/FrameGeometry.h"
#include "base/BinaryStream.h"
#include "base/Simd.h"
#include "series/FrameBatch.h"
#include "series/RegressorBand.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr const char * StreamName = "FrameSums";
}

FrameProducts::FrameProducts(std::size_t pixels, std::size_t frames, std::size_t cells)
  : m_Pixels(pixels)
  , m_Frames(frames)
  , m_Cells(cells)
  , m_ClassSums(frames * GradientClasses, ColumnVector::Zero())
  , m_InstrumentSums(frames * Blocks, { 0.0, 0.0 })
  , m_CellSums(frames * cells, { 0.0, 0.0 })
{}

void
FrameProducts::Merge(const FrameProducts & other)
{
  if (other.m_Pixels != m_Pixels || other.m_Frames != m_Frames || other.m_Cells != m_Cells)
  {
    throw std::invalid_argument("sums of " + other.Sizes() + " cannot be merged into sums of " + this->Sizes());
  }
  for (std::size_t i = 0; i < m_ClassSums.size(); ++i)
  {
    m_ClassSums[i] += other.m_ClassSums[i];
  }
  for (std::size_t i = 0; i < m_InstrumentSums.size(); ++i)
  {
    m_InstrumentSums[i][0] += other.m_InstrumentSums[i][0];
    m_InstrumentSums[i][1] += other.m_InstrumentSums[i][1];
  }
  for (std::size_t i = 0; i < m_CellSums.size(); ++i)
  {
    m_CellSums[i][0] += other.m_CellSums[i][0];
    m_CellSums[i][1] += other.m_CellSums[i][1];
  }
}

void
FrameProducts::Forget()
{
  *this = FrameProducts(m_Pixels, m_Frames, m_Cells);
}

void
FrameProducts::Save(std::ostream & out) const
{
  WriteSumsHeader(out, StreamName, m_Pixels, m_Frames);
  WriteCount(out, m_Cells);
  for (const ColumnVector & sums : m_ClassSums)
  {
    WriteNumbers(out, sums.data(), FrameColumns);
  }
  for (const auto * sums : { &m_InstrumentSums, &m_CellSums })
  {
    for (const std::array<double, 2> & pair : *sums)
    {
      WriteNumbers(out, pair.data(), pair.size());
    }
  }
}

void
FrameProducts::Restore(std::istream & in)
{
  FrameProducts       read(m_Pixels, m_Frames, m_Cells);
  const std::uint64_t frames = ReadSumsHeader(in, StreamName, m_Pixels);
  RequireCount("frames", frames, m_Frames);
  RequireCount("cells", ReadCount(in), m_Cells);
  for (ColumnVector & sums : read.m_ClassSums)
  {
    ReadNumbers(in, sums.data(), FrameColumns);
  }
  for (auto * sums : { &read.m_InstrumentSums, &read.m_CellSums })
  {
    for (std::array<double, 2> & pair : *sums)
    {
      ReadNumbers(in, pair.data(), pair.size());
    }
  }
  *this = std::move(read);
}

std::string
FrameProducts::Sizes() const
{
  return std::to_string(m_Pixels) + " pixels, " + std::to_string(m_Frames) + " frames and " + std::to_string(m_Cells) +
         " cells";
}

namespace
{
/** Size of the sums of a plane, by rows of cells, over the frames that are added together [bytes]: 170 frames of 512
 * rows or more. The columns of a plane are computed again for every batch, which takes as long as a dozen frames.
 * Chosen empirically: half makes two batches of 100 frames; twice as much makes one batch of 200 and takes 4 MiB more.
 */
constexpr std::size_t BytesOfBatch = std::size_t{ 4 } << 20;

/** \class InstrumentRun
 * \brief The terms of the noise of the instruments for some pixels, stored for SIMD. */
class InstrumentRun
{
public:
  static constexpr std::size_t Pixels = 256;
  static constexpr std::size_t Terms = 4; ///< w, and the products of the instruments times their weights w: xx, xy, yy

  /** Computes the terms of the pixels [first, last); pixels that are not used have 0. */
  void
  Fill(const FrameRegressors & regressors, std::size_t first, std::size_t last)
  {
    const ShiftInstruments & instruments = regressors.GetInstruments();
    const float * const      weights = instruments.weight.data() + first;
    const float * const      xs = instruments.x.data() + first;
    const float * const      ys = instruments.y.data() + first;
    for (std::size_t i = 0; i < last - first; ++i)
    {
      const bool   serves = regressors.ClassOf(first + i) != FrameRegressors::Unused;
      const double weight = serves ? double{ weights[i] } : 0.0;
      const double x = serves ? xs[i] * weight : 0.0;
      const double y = serves ? ys[i] * weight : 0.0;
      m_Terms[0][i] = weight;
      m_Terms[1][i] = x * x;
      m_Terms[2][i] = x * y;
      m_Terms[3][i] = y * y;
    }
    const float * const level = regressors.GetFrame().neighbourMean.data();
    std::copy(level + first, level + last, m_Level.begin());
    m_Pixels = last - first;
  }
  /** Adds the sums of the terms, and of the terms times the level. */
  void
  AddTo(std::array<double, 2 * Terms> & total) const
  {
    for (std::size_t k = 0; k < Terms; ++k)
    {
      const double * const terms = m_Terms[k].data();
      const double * const level = m_Level.data();
      total[k] += SumOfRun(m_Pixels, [=](std::size_t i) { return terms[i]; });
      total[Terms + k] += SumOfRun(m_Pixels, [=](std::size_t i) { return terms[i] * level[i]; });
    }
  }

private:
  std::array<std::array<double, Pixels>, Terms> m_Terms{};
  std::array<double, Pixels>                    m_Level{};
  std::size_t                                   m_Pixels{ 0 };
};
} // namespace

FrameSums::FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor)
  : m_Regressors(std::move(regressors))
  , m_Layout(PixelLayout::OfFrames(this->GetFrame().geometry))
  , m_CellRows(std::clamp<std::size_t>(this->GetFrame().geometry.height / 8, 1, 64))
  , m_CellsPerRow(std::clamp<std::size_t>(this->GetFrame().geometry.width / 32, 1, 16))
  , m_Products(this->GetFrame().mean.size(), this->GetFrame().frames, m_CellRows * m_CellsPerRow)
  , m_ClassGram(GradientClasses, ClassMatrix::Zero())
  , m_InstrumentGrams(FrameProducts::Blocks, InstrumentGram::Zero())
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
  const std::size_t together = std::max(RegressorBand::Together, BytesOfBatch / (cellRows * sizeof(detail::RowSums)));
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
                          std::vector<std::vector<detail::RowSums>>(cellRows),
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
    detail::AddToClasses(
      band,
      band.MultiplyByValues(first),
      std::min(RegressorBand::Together, FrameColumns - first),
      [&](std::size_t k) -> detail::ClassColumns & { return columns.ofClasses[first + k]; },
      [&](std::size_t cell, std::size_t k, const detail::GroupColumns & sum) {
        cells[cell].sum[first + k] += sum.ofCell[0];
        cells[cell].sumI[first + k] += sum.ofCell[1];
        columns.ofInstruments[this->BlockOfCell(cell)].col(static_cast<Eigen::Index>(first + k)) +=
          Eigen::Vector2d(sum.ofInstruments[0], sum.ofInstruments[1]);
      });
  }
}

void
FrameSums::TakeColumns(const std::vector<ColumnSums> & ofCellRows)
{
  for (std::size_t cellRow = 0; cellRow < ofCellRows.size(); ++cellRow)
  {
    const ColumnSums & columns = ofCellRows[cellRow];
    for (std::size_t k = 0; k < FrameColumns; ++k)
    {
      for (std::size_t c = 0; c < GradientClasses; ++c)
      {
        m_ClassGram[c].col(static_cast<Eigen::Index>(k)) +=
          Eigen::Map<const ColumnVector>(columns.ofClasses[k][c].data());
      }
    }
    for (std::size_t block = 0; block < FrameProducts::BlocksPerAxis; ++block)
    {
      m_InstrumentGrams[this->BlockOfRow(cellRow) * FrameProducts::BlocksPerAxis + block] +=
        columns.ofInstruments[block];
    }
  }
  for (ClassMatrix & gram : m_ClassGram) // the factors of both halves are rounded differently
  {
    gram = (0.5 * (gram + gram.transpose())).eval();
  }
  m_HasColumns = true;
}

Eigen::Vector2d
FrameSums::GetInstrumentSums(std::size_t t) const
{
  Eigen::Vector2d sums = Eigen::Vector2d::Zero();
  for (std::size_t block = 0; block < FrameProducts::Blocks; ++block)
  {
    sums += this->GetInstrumentSums(t, block);
  }
  return sums;
}

FrameSums::InstrumentGram
FrameSums::GetInstrumentGram() const
{
  InstrumentGram gram = InstrumentGram::Zero();
  for (const InstrumentGram & ofBlock : m_InstrumentGrams)
  {
    gram += ofBlock;
  }
  return gram;
}

double
FrameSums::FractionOfBlock(std::size_t block) const
{
  double all = 0.0;
  double own = 0.0;
  for (std::size_t c = 0; c < m_Cells.size(); ++c)
  {
    const auto        pixels = static_cast<double>(m_Cells[c].pixels);
    const std::size_t row = this->BlockOfRow(c / m_CellsPerRow);
    all += pixels;
    own += row * FrameProducts::BlocksPerAxis + this->BlockOfCell(c % m_CellsPerRow) == block ? pixels : 0.0;
  }
  return all > 0.0 ? own / all : 0.0;
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
