// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_DefectCorrection_h
#define sensornoise_simulation_DefectCorrection_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const DefectCorrectionSettings & settings);

/** Returns \a codesDn with corrected defects [DN]; every decision uses the uncorrected frame. */
SensorNoise_EXPORT DoubleFrame
CorrectDefects(const DoubleFrame & codesDn, const DefectCorrectionSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
