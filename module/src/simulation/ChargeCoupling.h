// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ChargeCoupling_h
#define sensornoise_simulation_ChargeCoupling_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const CouplingSettings & settings);

/** The signals [e-] that are read where the charges are \a charge [e-]. */
SensorNoise_EXPORT DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
