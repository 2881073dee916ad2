// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameResampling_h
#define sensornoise_simulation_FrameResampling_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResamplingSettings & settings);

/** Returns \a codesDn shifted [DN]. */
SensorNoise_EXPORT DoubleFrame
ResampleFrame(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
