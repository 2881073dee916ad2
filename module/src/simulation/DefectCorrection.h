// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_DefectCorrection_h
#define sensornoise_simulation_DefectCorrection_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** Correction of defective pixels on the fly, frame by frame, as cameras without a map of defects do: a pixel that
 * departs from the median of its eight neighbours by more than so many standard deviations of these neighbours (divisor
 * 7; fewer neighbours at the edge) becomes that median. Not linear: with a low threshold it takes away the tails of the
 * noise. */
struct DefectCorrectionSettings
{
  /** Threshold in units of the neighbours' standard deviation [1], above 0; 0: no correction. */
  double thresholdSd{ 0.0 };

  bool
  IsOn() const
  {
    return thresholdSd > 0.0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const DefectCorrectionSettings & settings);

/** \a codesDn corrected [DN]; every decision looks at the frame as it came in. */
SensorNoise_EXPORT DoubleFrame
CorrectDefects(const DoubleFrame & codesDn, const DefectCorrectionSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
