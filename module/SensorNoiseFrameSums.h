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

#include "SensorNoiseFrameProducts.h"
#include "SensorNoiseProvisionalModel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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
 * is made by the constructor.
 * Memory: 25 bytes a pixel, 16 kB a frame. */
class FrameSums
{
public:
  static constexpr std::size_t  Instruments = 2;
  static constexpr std::size_t  CellColumns = 2;
  static constexpr std::size_t  Columns = FrameColumns + Instruments + CellColumns;
  static constexpr std::uint8_t Unused = 255;

  using ClassMatrix = Eigen::Matrix<double, FrameColumns, FrameColumns>;
  using ColumnVector = FrameProducts::ColumnVector;

  /** Sums that need no frame, of one cell: of w, w I, w I^2, and of w D_k and w I D_k. */
  struct Cell
  {
    std::size_t                          pixels{ 0 };
    double                               w{ 0.0 };
    double                               wI{ 0.0 };
    double                               wII{ 0.0 };
    std::array<double, NumberOfStencils> wD{};
    std::array<double, NumberOfStencils> wID{};
  };

  /** \a take has a nonzero value at the pixels to be summed; they must be usable. The frame must outlive the sums. */
  FrameSums(const ReferenceFrame &            frame,
            const ProvisionalModel &          model,
            const std::vector<std::uint8_t> & take,
            std::vector<double>               smoothX,
            std::vector<double>               smoothY,
            std::vector<double>               smoothWeight,
            const ParallelFor &               parallelFor = SerialFor)
    : m_Frame(&frame)
    , m_Model(model)
    , m_ClassOf(frame.mean.size(), Unused)
    , m_SmoothX(std::move(smoothX))
    , m_SmoothY(std::move(smoothY))
    , m_SmoothWeight(std::move(smoothWeight))
    , m_CellRows(std::clamp<std::size_t>(frame.geometry.height / 8, 1, 64))
    , m_CellsPerRow(std::clamp<std::size_t>(frame.geometry.width / 32, 1, 16))
    , m_Products(frame.mean.size(), frame.frames, m_CellRows * m_CellsPerRow)
    , m_ClassGram(GradientClasses, ClassMatrix::Zero())
    , m_InstrumentGram(Eigen::Matrix<double, Instruments, FrameColumns>::Zero())
    , m_Cells(m_CellRows * m_CellsPerRow)
  {
    this->ClassifyPixels(take);
    this->AddGroup<double>(nullptr, 0, 0, parallelFor); // the Gram matrices
  }

  /** Adds frames first ... first + count - 1, stored one after the other. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    constexpr std::size_t group = 64; // bounds the memory of the parts
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
  void
  Merge(const FrameSums & other)
  {
    m_Products.Merge(other.m_Products);
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

  const ReferenceFrame &
  GetFrame() const
  {
    return *m_Frame;
  }
  const ProvisionalModel &
  GetModel() const
  {
    return m_Model;
  }
  /** The level that is subtracted from the mean in column 1, for conditioning [DN]. */
  double
  GetCentreDn() const
  {
    return m_Model.averageDn;
  }
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_ClassOf[p];
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
  double
  SmoothX(std::size_t p) const
  {
    return m_SmoothX[p] * m_SmoothWeight[p];
  }
  double
  SmoothY(std::size_t p) const
  {
    return m_SmoothY[p] * m_SmoothWeight[p];
  }
  double
  SmoothWeight(std::size_t p) const
  {
    return m_SmoothWeight[p];
  }

private:
  using Row = std::array<double, 16>; // Columns, padded for the vector units
  static_assert(Columns <= 16, "a row holds all columns");

  static constexpr std::size_t BlockSize = 512; // its rows stay in the second-level cache

  /** A run of pixels of a cell, ordered by class. */
  struct Block
  {
    std::vector<std::size_t>                     pixels;
    std::array<std::size_t, GradientClasses + 1> begin{};
    std::vector<double>                          mean;
    std::vector<Row>                             rows;
  };

  void
  ClassifyPixels(const std::vector<std::uint8_t> & take)
  {
    const auto &      stencils = MotionStencils();
    const std::size_t width = m_Frame->geometry.width;
    const double *    mean = m_Frame->mean.data();
    const auto        roughness = [&](std::size_t p) {
      const double gx = ApplyStencil(stencils[StencilX], mean, width, p);
      const double gy = ApplyStencil(stencils[StencilY], mean, width, p);
      const double xx = ApplyStencil(stencils[StencilXX], mean, width, p);
      const double yy = ApplyStencil(stencils[StencilYY], mean, width, p);
      return (gx * gx + gy * gy + 0.25 * (xx * xx + yy * yy)) / m_Model.NoiseVariance(m_Frame->neighbourMean[p]);
    };
    std::vector<double> values;
    for (const std::size_t p : detail::SamplePixels(take))
    {
      values.push_back(roughness(p));
    }
    std::array<double, GradientClasses - 1> edges{ 0.4, 0.6, 0.75, 0.87, 0.95 };
    for (double & edge : edges)
    {
      edge = values.empty() ? 0.0 : Quantile(values, edge);
    }
    for (std::size_t p = 0; p < take.size(); ++p)
    {
      if (take[p] != 0)
      {
        m_ClassOf[p] =
          static_cast<std::uint8_t>(std::lower_bound(edges.begin(), edges.end(), roughness(p)) - edges.begin());
      }
    }
  }

  /** Columns of pixel \a p, times their weights. */
  void
  FillRow(std::size_t p, Row & row, std::array<double, NumberOfStencils> & derivatives) const
  {
    const auto &      stencils = MotionStencils();
    const std::size_t width = m_Frame->geometry.width;
    const double      level = m_Frame->neighbourMean[p];
    const double      w = 1.0 / m_Model.NoiseVariance(level);
    const double      centred = m_Frame->mean[p] - this->GetCentreDn();
    row.fill(0.0);
    row[0] = w;
    row[1] = w * centred;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      derivatives[k] = ApplyStencil(stencils[k], m_Frame->mean.data(), width, p);
      row[2 + k] = w * derivatives[k];
    }
    row[FrameColumns] = this->SmoothX(p);
    row[FrameColumns + 1] = this->SmoothY(p);
    // Motion that the derivatives do not explain is noise to the light's local changes.
    const double motion = m_Model.MotionVariance(derivatives[StencilX], derivatives[StencilY]);
    row[FrameColumns + Instruments] = 1.0 / (m_Model.NoiseVariance(level) + 0.2 * motion);
    row[FrameColumns + Instruments + 1] = row[FrameColumns + Instruments] * centred;
  }

  void
  AddToGrams(std::size_t                                        p,
             const Row &                                        row,
             const std::array<double, NumberOfStencils> &       derivatives,
             Cell &                                             cell,
             std::vector<ClassMatrix> &                         gram,
             Eigen::Matrix<double, Instruments, FrameColumns> & instruments) const
  {
    const double centred = m_Frame->mean[p] - this->GetCentreDn();
    ColumnVector values;
    values(0) = 1.0;
    values(1) = centred;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      values(static_cast<Eigen::Index>(2 + k)) = derivatives[k];
    }
    gram[m_ClassOf[p]].noalias() += row[0] * values * values.transpose();
    instruments.row(0) += row[FrameColumns] * values.transpose();
    instruments.row(1) += row[FrameColumns + 1] * values.transpose();
    const double w = row[FrameColumns + Instruments];
    ++cell.pixels;
    cell.w += w;
    cell.wI += w * centred;
    cell.wII += w * centred * centred;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      cell.wD[k] += w * derivatives[k];
      cell.wID[k] += w * centred * derivatives[k];
    }
  }

  Block
  MakeBlock(const std::vector<std::size_t> & pixels) const
  {
    Block block;
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      block.begin[c] = block.pixels.size();
      std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(block.pixels), [&](std::size_t p) {
        return m_ClassOf[p] == c;
      });
    }
    block.begin[GradientClasses] = block.pixels.size();
    block.rows.resize(block.pixels.size());
    for (const std::size_t p : block.pixels)
    {
      block.mean.push_back(m_Frame->mean[p]);
    }
    return block;
  }

  /** Adds \a count frames; with 0, what needs no frame: Gram matrices and cells. */
  template <typename TPixel>
  void
  AddGroup(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    struct Part
    {
      std::vector<std::array<Row, GradientClasses>>    sums;
      std::vector<ClassMatrix>                         gram{ GradientClasses, ClassMatrix::Zero() };
      Eigen::Matrix<double, Instruments, FrameColumns> instruments =
        Eigen::Matrix<double, Instruments, FrameColumns>::Zero();
    };
    const bool        isGram = count == 0;
    const std::size_t pixels = m_Frame->mean.size();
    const std::size_t width = m_Frame->geometry.width;
    std::vector<Part> parts(m_CellRows);
    parallelFor(m_CellRows, [&](std::size_t cellRow) {
      Part & part = parts[cellRow];
      part.sums.assign(count, {});
      const std::size_t top = m_Frame->geometry.height * cellRow / m_CellRows;
      const std::size_t bottom = m_Frame->geometry.height * (cellRow + 1) / m_CellRows;
      for (std::size_t column = 0; column < m_CellsPerRow; ++column)
      {
        const std::size_t        c = cellRow * m_CellsPerRow + column;
        const std::size_t        right = width * (column + 1) / m_CellsPerRow;
        std::vector<std::size_t> run;
        const auto               flush = [&] {
          Block block = this->MakeBlock(run);
          run.clear();
          std::array<double, NumberOfStencils> derivatives{};
          for (std::size_t i = 0; i < block.pixels.size(); ++i)
          {
            this->FillRow(block.pixels[i], block.rows[i], derivatives);
            if (isGram)
            {
              this->AddToGrams(block.pixels[i], block.rows[i], derivatives, m_Cells[c], part.gram, part.instruments);
            }
          }
          for (std::size_t t = 0; t < count; ++t)
          {
            this->AddBlock(block, frames + t * pixels, part.sums[t], m_Products.OfCell(first + t, c));
          }
        };
        for (std::size_t y = top; y < bottom; ++y)
        {
          for (std::size_t p = y * width + width * column / m_CellsPerRow; p < y * width + right; ++p)
          {
            if (m_ClassOf[p] != Unused)
            {
              run.push_back(p);
              if (run.size() == BlockSize)
              {
                flush();
              }
            }
          }
        }
        flush();
      }
    });
    for (const Part & part : parts)
    {
      for (std::size_t t = 0; t < count; ++t)
      {
        for (std::size_t c = 0; c < GradientClasses; ++c)
        {
          const Row & row = part.sums[t][c];
          for (std::size_t k = 0; k < FrameColumns; ++k)
          {
            m_Products.OfClass(first + t, c)(static_cast<Eigen::Index>(k)) += row[k];
          }
          m_Products.OfInstruments(first + t)[0] += row[FrameColumns];
          m_Products.OfInstruments(first + t)[1] += row[FrameColumns + 1];
        }
      }
      for (std::size_t c = 0; c < GradientClasses && isGram; ++c)
      {
        m_ClassGram[c] += part.gram[c];
      }
      m_InstrumentGram += part.instruments;
    }
  }

  template <typename TPixel>
  static void
  AddBlock(const Block &                      block,
           const TPixel *                     frame,
           std::array<Row, GradientClasses> & sums,
           std::array<double, 2> &            cellSums)
  {
    std::array<double, 2> cell{ 0.0, 0.0 };
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      Row sum{};
      for (std::size_t i = block.begin[c]; i < block.begin[c + 1]; ++i)
      {
        const double deviation = static_cast<double>(frame[block.pixels[i]]) - block.mean[i];
        const Row &  row = block.rows[i];
        for (std::size_t k = 0; k < row.size(); ++k)
        {
          sum[k] += deviation * row[k];
        }
      }
      for (std::size_t k = 0; k < sum.size(); ++k)
      {
        sums[c][k] += sum[k];
      }
      cell[0] += sum[FrameColumns + Instruments];
      cell[1] += sum[FrameColumns + Instruments + 1];
    }
    cellSums[0] += cell[0];
    cellSums[1] += cell[1];
  }

  const ReferenceFrame *    m_Frame;
  ProvisionalModel          m_Model;
  std::vector<std::uint8_t> m_ClassOf;
  std::vector<double>       m_SmoothX;
  std::vector<double>       m_SmoothY;
  std::vector<double>       m_SmoothWeight;
  std::size_t               m_CellRows;
  std::size_t               m_CellsPerRow;

  FrameProducts                                    m_Products;
  std::vector<ClassMatrix>                         m_ClassGram;
  Eigen::Matrix<double, Instruments, FrameColumns> m_InstrumentGram;
  std::vector<Cell>                                m_Cells;
};

} // namespace sensornoise

#endif
