// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameRegressors_h
#define sensornoise_series_FrameRegressors_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

struct StaticScene;

/** Number of columns on which the frames are regressed: 1, the mean, and its derivatives (MotionStencils). */
inline constexpr std::size_t FrameColumns = 2 + NumberOfStencils;

/** Number of classes of the roughness of the surroundings of a pixel, from flat to rough. The regressions include the
 * classes one after the other. */
inline constexpr std::size_t GradientClasses = 6;

/** Returns the derivative of the mean by stencil \a k, smoothed, for all pixels [DN/pixel for the first derivatives].
 */
SensorNoise_EXPORT std::vector<float>
SmoothedDerivative(const ReferenceFrame & frame, StencilIndex k, const ParallelFor & parallelFor);

/** Returns the weights of the instruments: the inverse noise, smoothed, and falling smoothly to 0 where pixels are
 * missing from \a mask. Rough weights, or an edge that is half missing, would add short wavelengths. */
SensorNoise_EXPORT std::vector<float>
InstrumentWeight(const ReferenceFrame &            frame,
                 const InitialNoiseModel &         model,
                 const std::vector<std::uint8_t> & mask,
                 const ParallelFor &               parallelFor);

/** Instruments for the shifts along x and y: derivatives of long wavelengths, and their weights (see SolveShifts()).
 * Single precision is enough: an instrument that is off by a factor of 1 + 2^-24 is as valid, because all sums are made
 * of the same numbers. */
struct ShiftInstruments
{
  std::vector<float> x;      ///< smoothed derivative along x [DN/pixel]
  std::vector<float> y;      ///< smoothed derivative along y [DN/pixel]
  std::vector<float> weight; ///< see InstrumentWeight() [1/DN^2]
};

/** Makes the instruments over the pixels of \a mask. */
SensorNoise_EXPORT ShiftInstruments
MakeShiftInstruments(const ReferenceFrame &            frame,
                     const InitialNoiseModel &         model,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor);

/** \class FrameRegressors
 * \brief The weighted columns of every pixel, with which the frames are multiplied in the second pass.
 *
 * Column 0 is 1 and column 1 the mean minus the centre of the model, for conditioning. The derivatives of the mean
 * follow. The weight of these columns is the inverse noise of the initial model. Then follow two instruments for the
 * shifts, and 1 and the mean again, with weights for the sums of cells. Each pixel has a class, from flat to rough
 * surroundings. Memory: 13 bytes per pixel. */
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

/** Makes the regressors of the second pass, over all usable pixels except \a outliers, see FindOutlierPixels(). They
 * hold the address of the frame of \a scene, which must outlive them without being moved. */
SensorNoise_EXPORT FrameRegressors
MakeSceneRegressors(const StaticScene &               scene,
                    const std::vector<std::uint8_t> & outliers,
                    const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
