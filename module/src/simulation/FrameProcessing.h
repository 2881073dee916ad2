// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameProcessing_h
#define sensornoise_simulation_FrameProcessing_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"
#include "sensornoise/SensorFlaws.h"

/** \file
 * The order of the pieces that look at a whole frame. */

namespace sensornoise
{

/** Whether a row depends on other rows of its frame, or on other frames. */
inline bool
NeedsWholeFrames(const SensorFlaws & flaws)
{
  return flaws.brighterFatter.IsOn() || flaws.coupling.IsOn() || flaws.defectCorrection.IsOn() ||
         flaws.temporalFilter.IsOn() || flaws.median.IsOn() || flaws.smoothing.IsOn() || flaws.binning.IsOn() ||
         flaws.resampling.IsOn() || flaws.blocks.IsOn();
}

/** What happens to the charges [e-] between collection and read-out: brighter-fatter, then coupling. */
SensorNoise_EXPORT DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** What the camera does to its codes [DN] before the temporal filter: the correction of defects. */
SensorNoise_EXPORT DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame codesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** What it does after it: median, smoothing, binning, resampling, and last the compression in blocks, which needs the
 * converter's \a bitDepth. */
SensorNoise_EXPORT DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         codesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
