// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_limits_CramerRaoInput_h
#define sensornoise_limits_CramerRaoInput_h

#include "SensorNoiseExport.h"
#include "sensornoise/Simulator.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Input for the Cram\'er-Rao bound of a simulated stack. */
struct SensorNoise_EXPORT CramerRaoInput
{
  const double *          electrons;                 ///< p, the scene at rest, blurred by the optics [e-]
  const std::uint8_t *    mask;                      ///< nonzero where the pixel is used; null: everywhere
  std::size_t             width;                     ///< number of columns
  std::size_t             height;                    ///< number of rows
  const SimulationTruth * truth;                     ///< camera, flicker and shifts of the stack
  double                  quantisationStepDn{ 1.0 }; ///< quantization step [DN]; 0: no quantization

  /** Returns sigma^2 + step^2 / 12 [DN^2]. */
  double
  TotalReadVarianceDn2() const;

  /** Returns g times the mean of 1 + gamma: the mean flux of a pixel per electron of the scene [DN/e-]. */
  double
  MeanFluxPerElectronDn() const;
};

} // namespace sensornoise

#endif
