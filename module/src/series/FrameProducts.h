// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameProducts_h
#define sensornoise_series_FrameProducts_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "base/Stencils.h"

#include <array>
#include <cstddef>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

namespace sensornoise
{

/** Number of columns on which the frames are regressed: 1, the mean, and its derivatives (MotionStencils). */
inline constexpr std::size_t FrameColumns = 2 + NumberOfStencils;

/** Number of classes of the roughness of the surroundings of a pixel, from flat to rough. The regressions include the
 * classes one after the other. */
inline constexpr std::size_t GradientClasses = 6;

/** \class FrameProducts
 * \brief The sums of FrameSums that depend on the frames: their inner products, frame by frame.
 *
 * The products of a frame that was not added are 0. Sums of other frames are therefore merged by addition, which keeps
 * every bit: 0 is added to each number. (No number is -0, because each was added to 0 itself.) */
class SensorNoise_EXPORT FrameProducts
{
public:
  using ColumnVector = Eigen::Matrix<double, FrameColumns, 1>;

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
  /** Products of frame \a t with the two instruments, over all pixels: see SolveShifts(). */
  std::array<double, 2> &
  OfInstruments(std::size_t t)
  {
    return m_InstrumentSums[t];
  }
  const std::array<double, 2> &
  OfInstruments(std::size_t t) const
  {
    return m_InstrumentSums[t];
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

} // namespace sensornoise

#endif
