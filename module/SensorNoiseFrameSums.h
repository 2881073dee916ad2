/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef SensorNoiseFrameSums_h
#define SensorNoiseFrameSums_h

#include "SensorNoiseFrameRegressors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sensornoise
{

/** \class FrameSums
 * \brief The second pass: weighted inner products of every frame with the mean image and its derivatives.
 *
 * With d_t = u_t - mean, over the pixels x of each gradient class:
 *
 *     R[t][class][k] = sum_x w X_k(x) d_t(x),   X = (1, mean - centre, derivatives of the mean),   w = 1 / variance,
 *
 * over all pixels two sums with smoothed derivatives for the shifts (see ShiftSeries), and over each of up to 1024
 * rectangular cells the sums of w d_t and w (mean - centre) d_t, for light that differs over the frame (see
 * LocalIllumination). Estimator.md, 3.3.
 *
 * A frame's sums are made cell by cell in blocks of a fixed size: they do not depend on the chunks or the threads.
 * Sums of different frames are separate numbers, so parts of a stack are merged with the same bits. What needs no frame
 * is made by the constructor. Memory: 16 kB a frame. */
class FrameSums
{
public:
  static constexpr std::size_t Instruments = FrameRegressors::Instruments;

  using ClassMatrix = Eigen::Matrix<double, FrameColumns, FrameColumns>;
  using ColumnVector = FrameProducts::ColumnVector;

  /** Sums that need no frame, over one cell: of w X_k and w I X_k, I the mean minus the centre. */
  struct Cell
  {
    std::size_t                      pixels{ 0 };
    std::array<double, FrameColumns> sum{};
    std::array<double, FrameColumns> sumI{};
  };

  explicit FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor = SerialFor)
    : m_Regressors(std::move(regressors))
    , m_Frame(&m_Regressors.GetFrame())
    , m_CellRows(std::clamp<std::size_t>(m_Frame->geometry.height / 8, 1, 64))
    , m_CellsPerRow(std::clamp<std::size_t>(m_Frame->geometry.width / 32, 1, 16))
    , m_Products(m_Frame->mean.size(), m_Frame->frames, m_CellRows * m_CellsPerRow)
    , m_ClassGram(GradientClasses, ClassMatrix::Zero())
    , m_InstrumentGram(Eigen::Matrix<double, Instruments, FrameColumns>::Zero())
    , m_Cells(m_CellRows * m_CellsPerRow)
  {
    this->SumColumns(parallelFor);
  }

  /** Adds frames first ... first + count - 1, stored one after the other. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    constexpr std::size_t group = 128; // bounds the memory of the parts
    for (std::size_t begin = 0; begin < count; begin += group)
    {
      const std::size_t size = std::min(group, count - begin);
      this->AddGroup(frames + begin * m_Frame->mean.size(), first + begin, size, parallelFor);
    }
  }

  /** Adds the sums of other frames, made with the same frame, model and pixels. */
  void
  Merge(const FrameProducts & products)
  {
    m_Products.Merge(products);
  }
  /** Writes, or replaces, the sums of the frames that were added: see FrameProducts. */
  void
  Save(std::ostream & out) const
  {
    m_Products.Save(out);
  }
  void
  Restore(std::istream & in)
  {
    m_Products.Restore(in);
  }
  const FrameProducts &
  GetProducts() const
  {
    return m_Products;
  }

  const FrameRegressors &
  GetRegressors() const
  {
    return m_Regressors;
  }
  const ReferenceFrame &
  GetFrame() const
  {
    return *m_Frame;
  }
  const ColumnVector &
  GetClassSums(std::size_t t, std::size_t gradientClass) const
  {
    return m_Products.OfClass(t, gradientClass);
  }
  const std::array<double, 2> &
  GetInstrumentSums(std::size_t t) const
  {
    return m_Products.OfInstruments(t);
  }
  /** Sums of w d_t and w I d_t over cell \a c. */
  const std::array<double, 2> &
  GetCellSums(std::size_t t, std::size_t c) const
  {
    return m_Products.OfCell(t, c);
  }
  const std::vector<Cell> &
  GetCells() const
  {
    return m_Cells;
  }
  const ClassMatrix &
  GetClassGram(std::size_t gradientClass) const
  {
    return m_ClassGram[gradientClass];
  }
  const Eigen::Matrix<double, Instruments, FrameColumns> &
  GetInstrumentGram() const
  {
    return m_InstrumentGram;
  }

private:
  using Row = FrameRegressors::Row;
  using ClassRows = std::array<Row, GradientClasses>;

  static constexpr std::size_t BlockSize = 512; // its rows stay in the second-level cache
  static constexpr std::size_t Together = 4;    // series, and columns, whose sums stay in registers

  /** A run of pixels of a cell, ordered by class. */
  struct Block
  {
    std::vector<std::size_t>                     pixels;
    std::array<std::size_t, GradientClasses + 1> begin{};
    std::vector<double>                          mean;
    std::vector<FrameRegressors::Values>         values;
    std::vector<Row>                             rows;
  };

  Block
  MakeBlock(const std::vector<std::size_t> & run) const
  {
    Block block;
    for (const std::size_t p : run)
    {
      ++block.begin[m_Regressors.ClassOf(p) + 1U];
    }
    std::partial_sum(block.begin.begin(), block.begin.end(), block.begin.begin());
    std::array<std::size_t, GradientClasses + 1> next = block.begin;
    block.pixels.resize(run.size());
    block.mean.reserve(run.size());
    block.values.reserve(run.size());
    block.rows.reserve(run.size());
    for (const std::size_t p : run)
    {
      block.pixels[next[m_Regressors.ClassOf(p)]++] = p;
    }
    for (const std::size_t p : block.pixels)
    {
      block.mean.push_back(m_Frame->mean[p]);
      block.values.push_back(m_Regressors.ValuesOf(p));
      block.rows.push_back(m_Regressors.RowOf(p, block.values.back()));
    }
    return block;
  }

  /** Calls function(row of cells, cell, block) for all blocks, those of a row of cells in order. */
  template <typename TFunction>
  void
  ForCellBlocks(const ParallelFor & parallelFor, TFunction function) const
  {
    parallelFor(m_CellRows, [&](std::size_t cellRow) {
      const std::size_t height = m_Frame->geometry.height;
      const std::size_t width = m_Frame->geometry.width;
      for (std::size_t column = 0; column < m_CellsPerRow; ++column)
      {
        const std::size_t        cell = cellRow * m_CellsPerRow + column;
        std::vector<std::size_t> run;
        for (std::size_t y = height * cellRow / m_CellRows; y < height * (cellRow + 1) / m_CellRows; ++y)
        {
          for (std::size_t x = width * column / m_CellsPerRow; x < width * (column + 1) / m_CellsPerRow; ++x)
          {
            if (m_Regressors.ClassOf(y * width + x) != FrameRegressors::Unused)
            {
              run.push_back(y * width + x);
            }
            if (run.size() == BlockSize)
            {
              function(cellRow, cell, this->MakeBlock(run));
              run.clear();
            }
          }
        }
        function(cellRow, cell, this->MakeBlock(run));
      }
    });
  }

  /** Adds the sums over a block of its rows times the values of \a count series, at most Together: value(i, k) is that
   * of the block's pixel i. Returns them summed over the classes, too. A series' bits do not depend on those beside it.
   */
  template <typename TValue>
  static std::array<Row, Together>
  SumBlock(const Block & block, std::size_t count, TValue value, ClassRows * sums)
  {
    using Index = Eigen::Index;
    using Vector = Eigen::Matrix<double, Together, 1>;
    std::array<Vector, BlockSize> values;
    for (std::size_t k = 0; k < Together; ++k)
    {
      for (std::size_t i = 0; i < block.pixels.size(); ++i)
      {
        values[i](static_cast<Index>(k)) = value(i, std::min(k, count - 1));
      }
    }
    std::array<Row, Together> whole{};
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      for (std::size_t column = 0; column < FrameRegressors::Columns; column += Together)
      {
        Eigen::Matrix<double, Together, Together> sum = Eigen::Matrix<double, Together, Together>::Zero();
        for (std::size_t i = block.begin[c]; i < block.begin[c + 1]; ++i)
        {
          sum.noalias() += Eigen::Map<const Vector>(block.rows[i].data() + column) * values[i].transpose();
        }
        for (std::size_t k = 0; k < count; ++k)
        {
          for (std::size_t j = 0; j < Together; ++j)
          {
            sums[k][c][column + j] += sum(static_cast<Index>(j), static_cast<Index>(k));
            whole[k][column + j] += sum(static_cast<Index>(j), static_cast<Index>(k));
          }
        }
      }
    }
    return whole;
  }

  /** What needs no frame: the rows times the columns' own values. */
  void
  SumColumns(const ParallelFor & parallelFor)
  {
    std::vector<std::array<ClassRows, FrameColumns>> parts(m_CellRows);
    this->ForCellBlocks(parallelFor, [&](std::size_t cellRow, std::size_t c, const Block & block) {
      Cell & cell = m_Cells[c];
      cell.pixels += block.pixels.size();
      for (std::size_t first = 0; first < FrameColumns; first += Together)
      {
        const std::size_t count = std::min(Together, FrameColumns - first);
        const auto        value = [&](std::size_t i, std::size_t k) { return block.values[i][first + k]; };
        const auto        whole = SumBlock(block, count, value, &parts[cellRow][first]);
        for (std::size_t k = 0; k < count; ++k)
        {
          cell.sum[first + k] += whole[k][FrameColumns + Instruments];
          cell.sumI[first + k] += whole[k][FrameColumns + Instruments + 1];
        }
      }
    });
    for (const auto & part : parts)
    {
      for (std::size_t k = 0; k < FrameColumns; ++k)
      {
        const auto column = static_cast<Eigen::Index>(k);
        for (std::size_t c = 0; c < GradientClasses; ++c)
        {
          m_ClassGram[c].col(column) += Eigen::Map<const ColumnVector>(part[k][c].data());
          m_InstrumentGram.col(column) += Eigen::Map<const Eigen::Vector2d>(part[k][c].data() + FrameColumns);
        }
      }
    }
  }

  /** Adds \a count frames. */
  template <typename TPixel>
  void
  AddGroup(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    const std::size_t                   pixels = m_Frame->mean.size();
    std::vector<std::vector<ClassRows>> parts(m_CellRows, std::vector<ClassRows>(count));
    this->ForCellBlocks(parallelFor, [&](std::size_t cellRow, std::size_t cell, const Block & block) {
      for (std::size_t t = 0; t < count; t += Together)
      {
        const std::size_t together = std::min(Together, count - t);
        const auto        deviation = [&](std::size_t i, std::size_t k) {
          return static_cast<double>(frames[(t + k) * pixels + block.pixels[i]]) - block.mean[i];
        };
        const auto whole = SumBlock(block, together, deviation, &parts[cellRow][t]);
        for (std::size_t k = 0; k < together; ++k)
        {
          m_Products.OfCell(first + t + k, cell)[0] += whole[k][FrameColumns + Instruments];
          m_Products.OfCell(first + t + k, cell)[1] += whole[k][FrameColumns + Instruments + 1];
        }
      }
    });
    for (const std::vector<ClassRows> & part : parts)
    {
      for (std::size_t t = 0; t < count; ++t)
      {
        for (std::size_t c = 0; c < GradientClasses; ++c)
        {
          const Row & row = part[t][c];
          m_Products.OfClass(first + t, c) += Eigen::Map<const ColumnVector>(row.data());
          m_Products.OfInstruments(first + t)[0] += row[FrameColumns];
          m_Products.OfInstruments(first + t)[1] += row[FrameColumns + 1];
        }
      }
    }
  }

  FrameRegressors        m_Regressors;
  const ReferenceFrame * m_Frame;
  std::size_t            m_CellRows;
  std::size_t            m_CellsPerRow;

  FrameProducts                                    m_Products;
  std::vector<ClassMatrix>                         m_ClassGram;
  Eigen::Matrix<double, Instruments, FrameColumns> m_InstrumentGram;
  std::vector<Cell>                                m_Cells;
};

} // namespace sensornoise

#endif
