// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameBinning_h
#define sensornoise_simulation_FrameBinning_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const BinningSettings & settings);

/** Returns \a codesDn binned, in the original size [DN]. Where whole squares fill the frame, its mean is kept. */
SensorNoise_EXPORT DoubleFrame
BinFrame(const DoubleFrame & codesDn, const BinningSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
