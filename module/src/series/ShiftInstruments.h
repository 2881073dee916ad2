// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_ShiftInstruments_h
#define sensornoise_series_ShiftInstruments_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Returns the derivative of the mean by stencil \a k, smoothed, for all pixels [DN/pixel for the first derivatives].
 */
SensorNoise_EXPORT std::vector<double>
SmoothedDerivative(const ReferenceFrame & frame, StencilIndex k, const ParallelFor & parallelFor);

/** Returns the weights of the instruments: the inverse noise, smoothed, and falling smoothly to 0 where pixels are
 * missing from \a mask. Rough weights, or an edge that is half missing, would add short wavelengths. */
SensorNoise_EXPORT std::vector<double>
InstrumentWeight(const ReferenceFrame &            frame,
                 const InitialNoiseModel &         model,
                 const std::vector<std::uint8_t> & mask,
                 const ParallelFor &               parallelFor);

/** Instruments for the shifts along x and y: derivatives of long wavelengths, and their weights (see SolveShifts()). */
struct ShiftInstruments
{
  std::vector<double> x;      ///< smoothed derivative along x [DN/pixel]
  std::vector<double> y;      ///< smoothed derivative along y [DN/pixel]
  std::vector<double> weight; ///< see InstrumentWeight() [1/DN^2]
};

/** Makes the instruments over the pixels of \a mask. */
SensorNoise_EXPORT ShiftInstruments
MakeShiftInstruments(const ReferenceFrame &            frame,
                     const InitialNoiseModel &         model,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
