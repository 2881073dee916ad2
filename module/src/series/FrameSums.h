// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameSums_h
#define sensornoise_series_FrameSums_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameProducts.h"
#include "series/FrameRegressors.h"

#include <array>
#include <cstddef>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

class RegressorBand;

/** Sums of what noise of variance V does to the instruments: of w V, and of z z' V, z the instruments with their
 * weights. */
struct InstrumentNoise
{
  double          variance{ 0.0 };
  Eigen::Matrix2d squares{ Eigen::Matrix2d::Zero() };
};

/** \class FrameSums
 * \brief The second pass: weighted inner products of every frame with the mean image and its derivatives.
 *
 * With d_t = u_t - mean, over the pixels x of each gradient class:
 *
 *     R[t][class][k] = sum_x w X_k(x) d_t(x),   X = (1, mean - centre, derivatives of the mean),   w = 1 / variance,
 *
 * over all pixels two sums with smoothed derivatives for the shifts (see SolveShifts), and over each of up to 1024
 * rectangular cells the sums of w d_t and w (mean - centre) d_t, for light that differs over the frame (see
 * LocalIllumination). Estimator.md, 3.3.
 *
 * A frame's sums are made row by row in bands of a fixed height: they do not depend on the chunks or the threads.
 * Sums of different frames are separate numbers, so parts of a stack are merged with the same bits. What needs no frame
 * is made together with the first frames, or by EndFrames(). Memory: 16 kB a frame. */
class SensorNoise_EXPORT FrameSums
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

  /** The frame of \a regressors must outlive the object and its copies, at its place. */
  explicit FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor = SerialFor);

  /** The pixels of the frames to come stand as \a layout says; without it, one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds frames first ... first + count - 1. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    AddFrames({ { this, first } }, frames, count, parallelFor);
  }

  /** The sums of one of the planes of a mosaic, and the number of the first frame among its own. */
  struct Plane
  {
    FrameSums * sums;
    std::size_t first;
  };
  /** Adds \a count frames to the sums of all \a planes: what one has read of a row is near when the next comes to it.
   */
  template <typename TPixel>
  static void
  AddFrames(const std::vector<Plane> & planes,
            const TPixel *             frames,
            std::size_t                count,
            const ParallelFor &        parallelFor);

  /** Adds the sums of other frames, made with the same frame, model and pixels. */
  void
  Merge(const FrameProducts & products)
  {
    m_Products.Merge(products);
  }
  /** No frame has been added: the products are 0. */
  void
  Forget()
  {
    m_Products.Forget();
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
    return m_Regressors.GetFrame();
  }
  /** All frames have been added: gives the memory of the instruments back. Before it, there may be no cells and no
   * Grams. */
  void
  EndFrames(const ParallelFor & parallelFor);
  /** For the variance V = \a intercept + \a gain mean. */
  InstrumentNoise
  NoiseOfInstruments(double gain, double intercept) const
  {
    return { intercept * m_OfOne.variance + gain * m_OfLevel.variance,
             intercept * m_OfOne.squares + gain * m_OfLevel.squares };
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
  /** Of a cell row: the sums of every column's weighted values times the values of each. */
  using ColumnSums = std::array<std::array<FrameRegressors::WeightedColumns, GradientClasses>, FrameColumns>;

  std::vector<ColumnSums>
  StartColumns();
  void
  AddColumns(RegressorBand & band, std::size_t cellRow, ColumnSums & columns);
  void
  TakeColumns(const std::vector<ColumnSums> & ofCellRows);
  void
  SumInstruments(const ParallelFor & parallelFor);

  template <typename TPixel>
  struct Batch;

  FrameRegressors m_Regressors;
  PixelLayout     m_Layout;
  std::size_t     m_CellRows;
  std::size_t     m_CellsPerRow;

  FrameProducts                                    m_Products;
  bool                                             m_HasColumns{ false }; // the next three are there
  std::vector<ClassMatrix>                         m_ClassGram;
  Eigen::Matrix<double, Instruments, FrameColumns> m_InstrumentGram;
  std::vector<Cell>                                m_Cells;
  InstrumentNoise                                  m_OfOne;   // of the variance 1
  InstrumentNoise                                  m_OfLevel; // of a variance that is the neighbours' mean
};

} // namespace sensornoise

#endif
