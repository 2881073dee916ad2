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
#ifndef sensornoise_series_FrameSums_h
#define sensornoise_series_FrameSums_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameRegressors.h"
#include "sensornoise/series/RegressorBand.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <ostream>
#include <utility>
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
 * A frame's sums are made line by line in bands of a fixed height: they do not depend on the chunks or the threads.
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

  static constexpr std::size_t BandPixels = 4096; // the band's rows stay in the second-level cache

  /** Calls function(row of cells, band) for all bands, those of a row of cells in order. */
  template <typename TFunction>
  void
  ForBands(const ParallelFor & parallelFor, TFunction function) const
  {
    parallelFor(m_CellRows, [&](std::size_t cellRow) {
      const FrameGeometry & geometry = m_Frame->geometry;
      const std::size_t     end = geometry.height * (cellRow + 1) / m_CellRows;
      const std::size_t     lines = std::max<std::size_t>(1, BandPixels / geometry.width);
      for (std::size_t y = geometry.height * cellRow / m_CellRows; y < end; y += lines)
      {
        function(cellRow, RegressorBand(m_Regressors, y, std::min(lines, end - y), m_CellsPerRow));
      }
    });
  }

  /** Adds the sums of \a count series over a band to theirs over the classes, and calls function(cell of the band,
   * series, sum of w, sum of w I) for the cells, group by group. */
  template <typename TFunction>
  static void
  AddToClasses(const RegressorBand &                    band,
               const std::vector<RegressorBand::Sums> & sums,
               std::size_t                              count,
               ClassRows *                              parts,
               TFunction                                function)
  {
    for (std::size_t g = 0; g < sums.size(); ++g)
    {
      const RegressorBand::Group & group = band.GetGroups()[g];
      for (std::size_t k = 0; k < count; ++k)
      {
        const double * const sum = sums[g].col(static_cast<Eigen::Index>(k)).data();
        Row &                row = parts[k][group.gradientClass];
        std::transform(row.begin(), row.end(), sum, row.begin(), std::plus<double>());
        function(group.cell, k, sum[FrameColumns + Instruments], sum[FrameColumns + Instruments + 1]);
      }
    }
  }

  /** What needs no frame: the rows times the columns' own values. */
  void
  SumColumns(const ParallelFor & parallelFor)
  {
    std::vector<std::array<ClassRows, FrameColumns>> parts(m_CellRows);
    this->ForBands(parallelFor, [&](std::size_t cellRow, const RegressorBand & band) {
      Cell * const cells = m_Cells.data() + cellRow * m_CellsPerRow;
      for (const RegressorBand::Group & group : band.GetGroups())
      {
        cells[group.cell].pixels += group.end - group.begin;
      }
      std::vector<FrameRegressors::Values> columns(band.Pixels());
      for (const std::uint32_t i : band.GetOrder())
      {
        columns[i] = m_Regressors.ValuesOf(band.First() + i);
      }
      std::vector<RegressorBand::Vector> values(band.Pixels(), RegressorBand::Vector::Zero());
      std::vector<RegressorBand::Sums>   sums;
      for (std::size_t first = 0; first < FrameColumns; first += RegressorBand::Together)
      {
        const std::size_t count = std::min(RegressorBand::Together, FrameColumns - first);
        for (const std::uint32_t i : band.GetOrder())
        {
          std::copy_n(columns[i].data() + first, count, values[i].data());
        }
        band.Multiply(values, sums);
        AddToClasses(
          band, sums, count, &parts[cellRow][first], [&](std::size_t cell, std::size_t k, double w, double wI) {
            cells[cell].sum[first + k] += w;
            cells[cell].sumI[first + k] += wI;
          });
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
    std::vector<std::vector<ClassRows>> parts(m_CellRows, std::vector<ClassRows>(count));
    this->ForBands(parallelFor, [&](std::size_t cellRow, const RegressorBand & band) {
      const double * const               mean = m_Frame->mean.data() + band.First();
      std::vector<RegressorBand::Vector> deviations(band.Pixels());
      std::vector<RegressorBand::Sums>   sums;
      for (std::size_t t = 0; t < count; t += RegressorBand::Together)
      {
        const std::size_t together = std::min(RegressorBand::Together, count - t);
        for (std::size_t k = 0; k < RegressorBand::Together; ++k)
        {
          const TPixel * const frame = frames + (t + std::min(k, together - 1)) * m_Frame->mean.size() + band.First();
          for (std::size_t i = 0; i < band.Pixels(); ++i)
          {
            deviations[i](static_cast<Eigen::Index>(k)) = static_cast<double>(frame[i]) - mean[i];
          }
        }
        band.Multiply(deviations, sums);
        AddToClasses(
          band, sums, together, &parts[cellRow][t], [&](std::size_t cell, std::size_t k, double w, double wI) {
            std::array<double, 2> & ofCell = m_Products.OfCell(first + t + k, cellRow * m_CellsPerRow + cell);
            ofCell[0] += w;
            ofCell[1] += wI;
          });
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
