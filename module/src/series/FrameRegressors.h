// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameRegressors_h
#define sensornoise_series_FrameRegressors_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/InitialNoiseModel.h"
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
 * \brief The weighted columns of every pixel, with which the frames are multiplied in the second pass.
 *
 * Column 0 is 1 and column 1 the mean minus the centre of the model, for conditioning. The derivatives of the mean
 * follow. The weight of these columns is the inverse noise of the initial model. Then follow two instruments for the
 * shifts, and 1 and the mean again, with weights for the sums of cells. Each pixel has a class, from flat to rough
 * surroundings. Memory: 25 bytes per pixel. */
class SensorNoise_EXPORT FrameRegressors
{
public:
  static constexpr std::size_t  Instruments = 2;
  static constexpr std::size_t  CellColumns = 2;
  static constexpr std::size_t  Columns = FrameColumns + Instruments + CellColumns;
  static constexpr std::uint8_t Unused = 255;

  using WeightedColumns = std::array<double, 16>; // Columns, padded for SIMD
  static_assert(Columns + 1 == std::tuple_size_v<WeightedColumns>, "the array holds all columns");

  /** \a take has a nonzero value at the pixels to be used; they must be usable. The object and its copies hold the
   * address of \a frame, which must outlive them without being moved. */
  FrameRegressors(const ReferenceFrame &            frame,
                  const InitialNoiseModel &         model,
                  const std::vector<std::uint8_t> & take,
                  ShiftInstruments                  instruments,
                  const ParallelFor &               parallelFor = SerialFor);
  /** Deleted: a temporary frame would be destroyed at once. */
  FrameRegressors(const ReferenceFrame &&,
                  const InitialNoiseModel &,
                  const std::vector<std::uint8_t> &,
                  ShiftInstruments,
                  const ParallelFor & = SerialFor) = delete;

  const ReferenceFrame &
  GetFrame() const
  {
    return *m_Frame;
  }
  const InitialNoiseModel &
  GetModel() const
  {
    return m_Model;
  }
  /** Returns the gradient class of pixel \a p; Unused if it is not used. */
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
  /** Returns the number of used pixels of a gradient class. */
  double
  PixelsOfClass(std::size_t gradientClass) const
  {
    return m_PixelsOfClass[gradientClass];
  }
  /** Releases the memory of the instruments, which do not exist from then on. */
  void
  ReleaseInstruments()
  {
    std::exchange(m_Instruments, {});
  }

private:
  void
  ClassifyPixels(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  const ReferenceFrame *              m_Frame;
  InitialNoiseModel                   m_Model;
  std::vector<std::uint8_t>           m_ClassOf;
  std::array<double, GradientClasses> m_PixelsOfClass{};
  ShiftInstruments                    m_Instruments;
};

} // namespace sensornoise

#endif
