/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/simulation/FrameProcessing.h"

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
  return flaws.defectCorrection.IsOn() ? CorrectDefects(codesDn, flaws.defectCorrection, parallelFor) : codesDn;
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
