// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"

#include "simulation/BlockQuantisation.h"
#include "simulation/BrighterFatter.h"
#include "simulation/ChargeCoupling.h"
#include "simulation/DefectCorrection.h"
#include "simulation/FrameBinning.h"
#include "simulation/FrameResampling.h"
#include "simulation/FrameSmoothing.h"
#include "simulation/MedianFilter.h"

#include <utility>

namespace sensornoise
{

DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor)
{
  if (flaws.brighterFatter.IsOn())
  {
    charge = SpreadCharge(charge, flaws.brighterFatter, parallelFor);
  }
  if (flaws.coupling.IsOn())
  {
    charge = CoupleCharge(charge, flaws.coupling, parallelFor);
  }
  return charge;
}

DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame codesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor)
{
  if (flaws.defectCorrection.IsOn())
  {
    codesDn = CorrectDefects(codesDn, flaws.defectCorrection, parallelFor);
  }
  return codesDn;
}

DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         codesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor)
{
  if (flaws.median.IsOn())
  {
    codesDn = FilterByMedian(codesDn, flaws.median, parallelFor);
  }
  if (flaws.smoothing.IsOn())
  {
    codesDn = SmoothFrame(std::move(codesDn), flaws.smoothing, parallelFor);
  }
  if (flaws.binning.IsOn())
  {
    codesDn = BinFrame(codesDn, flaws.binning, parallelFor);
  }
  if (flaws.resampling.IsOn())
  {
    codesDn = ResampleFrame(codesDn, flaws.resampling, parallelFor);
  }
  if (flaws.blocks.IsOn())
  {
    codesDn = QuantiseBlocks(codesDn, StepsOfQuality(flaws.blocks, bitDepth), parallelFor);
  }
  return codesDn;
}

} // namespace sensornoise
