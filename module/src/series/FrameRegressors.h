// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameRegressors_h
#define sensornoise_series_FrameRegressors_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameProducts.h"
#include "series/ShiftInstruments.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class FrameRegressors
 * \brief What the frames are multiplied with in the second pass: the columns of every pixel, times their weights.
 *
 * Column 0 is 1 and column 1 the mean minus the model's centre, for conditioning; then follow the derivatives of the
 * mean, with the inverse of the provisional noise as weight; two instruments for the shifts; and 1 and the mean again,
 * with weights for the sums of cells. Each pixel has a class, from flat to rough surroundings. Memory: 25 bytes a
 * pixel. */
class SensorNoise_EXPORT FrameRegressors
{
public:
  static constexpr std::size_t  Instruments = 2;
  static constexpr std::size_t  CellColumns = 2;
  static constexpr std::size_t  Columns = FrameColumns + Instruments + CellColumns;
  static constexpr std::uint8_t Unused = 255;

  using WeightedColumns = std::array<double, 16>; // Columns, padded for the vector units
  static_assert(Columns + 1 == std::tuple_size_v<WeightedColumns>, "the array holds all columns");

  /** \a take has a nonzero value at the pixels that serve; they must be usable. The object and its copies hold the
   * address of \a frame, which must outlive them at its place. */
  FrameRegressors(const ReferenceFrame &            frame,
                  const ProvisionalModel &          model,
                  const std::vector<std::uint8_t> & take,
                  ShiftInstruments                  instruments,
                  const ParallelFor &               parallelFor = SerialFor);
  /** A temporary frame would be gone at once. */
  FrameRegressors(const ReferenceFrame &&,
                  const ProvisionalModel &,
                  const std::vector<std::uint8_t> &,
                  ShiftInstruments,
                  const ParallelFor & = SerialFor) = delete;

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
  /** Gradient class of pixel \a p; Unused if it does not serve. */
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_ClassOf[p];
  }
  const ShiftInstruments &
  GetInstruments() const
  {
    return m_Instruments;
  }
  /** Pixels of a gradient class that serve. */
  double
  PixelsOfClass(std::size_t gradientClass) const
  {
    return m_PixelsOfClass[gradientClass];
  }
  /** Gives the memory of the instruments back, which are nowhere from then on. */
  void
  ReleaseInstruments()
  {
    std::exchange(m_Instruments, {});
  }

private:
  void
  ClassifyPixels(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  const ReferenceFrame *              m_Frame;
  ProvisionalModel                    m_Model;
  std::vector<std::uint8_t>           m_ClassOf;
  std::array<double, GradientClasses> m_PixelsOfClass{};
  ShiftInstruments                    m_Instruments;
};

} // namespace sensornoise

#endif
