// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ChargeCoupling_h
#define sensornoise_simulation_ChargeCoupling_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

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
