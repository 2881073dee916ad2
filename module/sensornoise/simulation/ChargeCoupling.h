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
#ifndef sensornoise_simulation_ChargeCoupling_h
#define sensornoise_simulation_ChargeCoupling_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/simulation/DoubleFrame.h"

namespace sensornoise
{

/** Interpixel capacitance: the voltage of a pixel shows part of its neighbours' charge. Linear and deterministic, after
 * the charge has been collected and before read noise, so that it also couples the shot noise (Moore, Ninkov and
 * Forrest 2004, Proc. SPIE 5167, DOI 10.1117/12.507330). */
struct CouplingSettings
{
  /** Fraction c of its signal that a pixel gives to each of its four neighbours [1], 0 to 0.2. CMOS and hybrid sensors:
   * up to about 0.02. The shot noise of an even area keeps (1 - 4 c)^2 + 4 c^2 of its variance. */
  double fraction{ 0.0 };

  bool
  IsOn() const
  {
    return fraction > 0.0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const CouplingSettings & settings);

/** The signals [e-] that are read where the charges are \a charge [e-]. */
SensorNoise_EXPORT DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
