// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ChargeExchange_h
#define sensornoise_simulation_ChargeExchange_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used with \a electrons in the brightest
 * pixel [e-]. */
SensorNoise_EXPORT void
CheckSettings(const BrighterFatterSettings & settings, double electrons);

/** Returns the collected charges [e-]; \a charge are the charges without the effect [e-]. */
SensorNoise_EXPORT DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const CouplingSettings & settings);

/** Returns the signals that are read for the charges \a charge [e-]. */
SensorNoise_EXPORT DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
