// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameSums_h
#define sensornoise_series_FrameSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/Eigen.h"
#include "base/PixelLayout.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameRegressors.h"

#include <array>
#include <cstddef>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class FrameProducts
 * \brief The sums of FrameSums that depend on the frames: their inner products, frame by frame.
 *
 * The products of a frame that was not added are 0. Sums of other frames are therefore merged by addition, which keeps
 * every bit: 0 is added to each number. (No number is -0, because each was added to 0 itself.) */
class SensorNoise_EXPORT FrameProducts
{
public:
  using ColumnVector = Eigen::Matrix<double, FrameColumns, 1>;

  /** The frame is divided into this many blocks along each axis, see SolveShifts(). */
  static constexpr std::size_t BlocksPerAxis = 4;
  static constexpr std::size_t Blocks = BlocksPerAxis * BlocksPerAxis;

  /** Constructs products of frames of \a pixels pixels, divided into \a cells cells; all products are 0. */
  FrameProducts(std::size_t pixels, std::size_t frames, std::size_t cells);

  /** Products of frame \a t with the columns over the pixels of a gradient class: R[t][class][k] of FrameSums. */

  ColumnVector &
  OfClass(std::size_t t, std::size_t gradientClass)
  {
    return m_ClassSums[t * GradientClasses + gradientClass];
  }
  const ColumnVector &
  OfClass(std::size_t t, std::size_t gradientClass) const
  {
    return m_ClassSums[t * GradientClasses + gradientClass];
  }
  /** Products of frame \a t with the two instruments, over the pixels of a block: see SolveShifts(). */
  std::array<double, 2> &
  OfInstruments(std::size_t t, std::size_t block)
  {
    return m_InstrumentSums[t * Blocks + block];
  }
  const std::array<double, 2> &
  OfInstruments(std::size_t t, std::size_t block) const
  {
    return m_InstrumentSums[t * Blocks + block];
  }
  /** Products of frame \a t with 1 and the mean minus the centre over cell \a c: see LocalIllumination. */
  std::array<double, 2> &
  OfCell(std::size_t t, std::size_t c)
  {
    return m_CellSums[t * m_Cells + c];
  }
  const std::array<double, 2> &
  OfCell(std::size_t t, std::size_t c) const
  {
    return m_CellSums[t * m_Cells + c];
  }

  /** Adds the products of other frames of the same stack. Throws std::invalid_argument if the sizes differ. */
  void
  Merge(const FrameProducts & other);

  /** Sets all products to 0: no frame has been added. */
  void
  Forget();

  /** Writes the products, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Replaces the products by the products of a stream. Throws std::runtime_error, and changes nothing, if it holds
   * other sums or ends early. */
  void
  Restore(std::istream & in);

private:
  std::string
  Sizes() const;

  std::size_t                        m_Pixels;
  std::size_t                        m_Frames;
  std::size_t                        m_Cells;
  std::vector<ColumnVector>          m_ClassSums;
  std::vector<std::array<double, 2>> m_InstrumentSums;
  std::vector<std::array<double, 2>> m_CellSums;
};

class RegressorBand;

/** Noise of the instruments for noise of variance V of the pixels: the sums of w V, and of z z' V, z the instruments
 * with their weights. */
struct InstrumentNoise
{
  double          variance{ 0.0 };                    ///< sum of w V
  Eigen::Matrix2d squares{ Eigen::Matrix2d::Zero() }; ///< sum of z z' V
};

/** \class FrameSums
 * \brief Sums of the second pass: weighted inner products of every frame with the mean image and its derivatives.
 *
 * With d_t = u_t - mean, over the pixels x of each gradient class:
 *
 *     R[t][class][k] = sum_x w X_k(x) d_t(x),   X = (1, mean - centre, derivatives of the mean),   w = 1 / variance,
 *
 * Over each of 16 blocks, two sums with smoothed derivatives are added for the shifts (see SolveShifts()). Over each of
 * up to 1024 rectangular cells, the sums of w d_t and w (mean - centre) d_t are added for local changes of the
 * illumination (see LocalIllumination). Estimator.md, 3.3.
 *
 * The sums of a frame are computed row by row in bands of a fixed height: they do not depend on the number of threads
 * or of frames per call. Sums of different frames are separate numbers, so that merged parts of a stack have the same
 * bits. The sums that need no frame are computed together with the first frames, or by EndFrames(). Memory: 16 kB per
 * frame. */
class SensorNoise_EXPORT FrameSums
{
public:
  static constexpr std::size_t Instruments = FrameRegressors::Instruments;

  using ClassMatrix = Eigen::Matrix<double, FrameColumns, FrameColumns>;
  using ColumnVector = FrameProducts::ColumnVector;
  using InstrumentGram = Eigen::Matrix<double, Instruments, FrameColumns>;

  /** Sums over one cell that need no frame: of w X_k and of w I X_k, I the mean minus the centre. */
  struct Cell
  {
    std::size_t                      pixels{ 0 }; ///< number of used pixels of the cell
    std::array<double, FrameColumns> sum{};       ///< sums of w X_k
    std::array<double, FrameColumns> sumI{};      ///< sums of w I X_k
  };

  /** The frame of \a regressors must outlive the object and its copies, without being moved. */
  explicit FrameSums(FrameRegressors regressors, const ParallelFor & parallelFor = SerialFor);

  /** Sets the layout of the pixels of the frames that are added. By default, frames are stored one after the other. */
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

  /** The sums of one of the planes of a mosaic, and the number of the first frame among its frames. */
  struct Plane
  {
    FrameSums * sums;
    std::size_t first;
  };
  /** Adds \a count frames to the sums of all \a planes. A row is read for all planes while it is in the cache. */
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
  /** Sets the products to 0: no frame has been added. */
  void
  Forget()
  {
    m_Products.Forget();
  }
  /** Writes or replaces the sums of the frames that were added, see FrameProducts. */
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
  /** Ends the second pass, after all frames have been added. Releases the memory of the instruments. Before it,
   * GetCells() and the Gram matrices may be empty. */
  void
  EndFrames(const ParallelFor & parallelFor);
  /** Returns the noise of the instruments for the variance V = \a intercept + \a gain mean [DN^2]. */
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
  /** Returns the sums of a frame with the two instruments over a block, see FrameProducts::BlocksPerAxis. */
  Eigen::Vector2d
  GetInstrumentSums(std::size_t t, std::size_t block) const
  {
    const std::array<double, 2> & sums = m_Products.OfInstruments(t, block);
    return { sums[0], sums[1] };
  }
  /** Returns these sums over the frame. */
  Eigen::Vector2d
  GetInstrumentSums(std::size_t t) const;
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
  /** Returns the number of cells side by side; GetCells() has them row by row. */
  std::size_t
  CellsPerRow() const
  {
    return m_CellsPerRow;
  }
  const ClassMatrix &
  GetClassGram(std::size_t gradientClass) const
  {
    return m_ClassGram[gradientClass];
  }
  /** Products of the instruments with the columns over a block of the frame. */
  const InstrumentGram &
  GetInstrumentGram(std::size_t block) const
  {
    return m_InstrumentGrams[block];
  }
  /** Returns these products over the frame. */
  InstrumentGram
  GetInstrumentGram() const;
  /** Returns the used pixels of a block as a fraction of the used pixels of the frame [1]. */
  double
  FractionOfBlock(std::size_t block) const;

private:
  /** Sums over a row of cells: the weighted values of every column times the values of each column by gradient class,
   * and the products of the instruments with the columns, for the blocks side by side. */
  struct ColumnSums
  {
    std::array<std::array<FrameRegressors::WeightedColumns, GradientClasses>, FrameColumns> ofClasses{};
    std::array<InstrumentGram, FrameProducts::BlocksPerAxis>                                ofInstruments;

    ColumnSums() { ofInstruments.fill(InstrumentGram::Zero()); }
  };

  /** Returns the block along y of a row of cells, and the block along x of a cell in a row. */
  std::size_t
  BlockOfRow(std::size_t cellRow) const
  {
    return cellRow * FrameProducts::BlocksPerAxis / m_CellRows;
  }
  std::size_t
  BlockOfCell(std::size_t cell) const
  {
    return cell * FrameProducts::BlocksPerAxis / m_CellsPerRow;
  }

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

  FrameProducts               m_Products;
  bool                        m_HasColumns{ false }; // whether the next three members are set
  std::vector<ClassMatrix>    m_ClassGram;
  std::vector<InstrumentGram> m_InstrumentGrams; // for each block
  std::vector<Cell>           m_Cells;
  InstrumentNoise             m_OfOne;   // noise at the variance 1
  InstrumentNoise             m_OfLevel; // noise at a variance equal to the mean of the neighbours
};

} // namespace sensornoise

#endif
