// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameProcessing_h
#define sensornoise_simulation_FrameProcessing_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"
#include "sensornoise/SensorFlaws.h"

/** \file
 * The processing of whole frames, in order. */

namespace sensornoise
{

/** Returns whether a row depends on other rows of its frame, or on other frames. */
inline bool
NeedsWholeFrames(const SensorFlaws & flaws)
{
  return flaws.brighterFatter.IsOn() || flaws.coupling.IsOn() || flaws.defectCorrection.IsOn() ||
         flaws.temporalFilter.IsOn() || flaws.median.IsOn() || flaws.smoothing.IsOn() || flaws.binning.IsOn() ||
         flaws.resampling.IsOn() || flaws.blocks.IsOn();
}

/** Redistributes the charges [e-] between collection and read-out: brighter-fatter effect, then coupling. */
SensorNoise_EXPORT DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the codes [DN] before the temporal filter: correction of defects. */
SensorNoise_EXPORT DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame codesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the codes [DN] after the temporal filter: median, smoothing, binning, resampling, and last the compression
 * in blocks, which needs the \a bitDepth of the converter. */
SensorNoise_EXPORT DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         codesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
