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
#ifndef sensornoise_limits_CramerRaoInput_h
#define sensornoise_limits_CramerRaoInput_h

#include "SensorNoiseExport.h"
#include "sensornoise/simulation/SimulationTruth.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** What the Cram\'er-Rao bound of a simulated stack depends on. */
struct SensorNoise_EXPORT CramerRaoInput
{
  const double *          electrons;                 ///< p: the scene at rest, blurred by the optics [e-]
  const std::uint8_t *    mask;                      ///< nonzero where the pixel is used; null: everywhere
  std::size_t             width;                     ///< columns
  std::size_t             height;                    ///< rows
  const SimulationTruth * truth;                     ///< camera, flicker and shifts of the stack
  double                  quantisationStepDn{ 1.0 }; ///< distance of the codes; 0: grey levels are not rounded [DN]

  /** sigma^2 + step^2 / 12 [DN^2]. */
  double
  TotalReadVarianceDn2() const;

  /** g times the mean of 1 + gamma: the mean flux of a pixel per electron of the scene [DN]. */
  double
  MeanFluxPerElectronDn() const;
};

} // namespace sensornoise

#endif
