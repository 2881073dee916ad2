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
#ifndef SensorNoiseSceneSeries_h
#define SensorNoiseSceneSeries_h

#include "SensorNoiseRefinedFindings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

/** What changes from frame to frame beside the noise: flicker, local light and motion, from the sums of the second
 * pass. The noise is the provisional model's. Returns the basis of the third pass. Throws std::runtime_error if the
 * pixels have one intensity. */
inline TemporalBasis
FindSceneSeries(const FrameSums & sums, RollingShutter rollingShutter, RefinedFindings & found)
{
  RegressorNoise noise; // w V = 1 with the model's own variance
  for (std::size_t p = 0; p < sums.GetFrame().mean.size(); ++p)
  {
    if (sums.ClassOf(p) != FrameSums::Unused)
    {
      noise.variance[sums.ClassOf(p)] += 1.0;
    }
  }
  const std::optional<OffsetLine> line = FitOffsetLine(sums, noise);
  if (!line)
  {
    throw std::runtime_error("the pixels have one intensity; expected dark and bright areas");
  }
  found.line = *line;
  const FrameEquations equations = MakeFrameEquations(sums, noise, GradientClasses - 1);
  const bool           isKnown = line->flickerZ > RequiredFlickerZ && std::isfinite(line->low);
  found.offsetInUse = isKnown ? line->offset : found.model.darkestDn - found.centreDn;
  found.motion = SolveMotion(equations, line->gamma, found.offsetInUse);
  const Eigen::MatrixXd motion = MotionColumns(found.motion, line->gamma);
  const std::size_t     most =
    rollingShutter == RollingShutter::Off ? 0 : std::min<std::size_t>(12, (sums.GetFrame().frames - 1) / 6);
  found.local = FindLocalIllumination(sums, found.motion, motion, line->gamma, found.offsetInUse, most);
  return TemporalBasis(line->gamma, found.local.series, motion);
}

/** Offset, flicker and shifts once more, with the noise that is now known. Needs no reading. */
inline void
PolishSceneSeries(const FrameSums &                 sums,
                  const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & mask,
                  RefinedFindings &                 found)
{
  const VarianceLine &   line = found.variance;
  const ReferenceFrame & frame = sums.GetFrame();
  RegressorNoise         noise;
  InstrumentNoise        instruments;
  const double           offsetDn = found.offsetInUse + found.centreDn;
  for (std::size_t p = 0; p < frame.mean.size(); ++p)
  {
    const std::uint8_t c = sums.ClassOf(p);
    if (c != FrameSums::Unused)
    {
      const double level = frame.neighbourMean[p];
      const double variance = line.At(level);
      const double w = 1.0 / found.model.NoiseVariance(level);
      noise.variance[c] += w * variance;
      noise.shot[c] += w * line.gain * std::max(0.0, level - offsetDn);
      const Eigen::Vector2d z(sums.SmoothX(p), sums.SmoothY(p));
      instruments.variance += sums.SmoothWeight(p) * variance;
      instruments.squares += variance * z * z.transpose();
    }
  }
  const std::vector<double>       gamma = found.line.gamma;
  const std::optional<OffsetLine> polished = FitOffsetLine(sums, noise, gamma);
  found.line = polished ? *polished : found.line;
  const FrameEquations            equations = MakeFrameEquations(sums, noise, GradientClasses - 1, gamma);
  const std::optional<OffsetLine> everywhere = FitOffsetLine(equations);
  found.motionPhi = everywhere ? everywhere->Widening() : 1.0;
  found.motion = SolveMotion(equations, found.line.gamma, found.line.offset);
  found.shifts = SolveShifts(sums, found.motion, instruments, found.line.gamma, found.line.offset);
  if (found.local.series.cols() > 0)
  {
    const LocalOffsetData data{
      projected, line, mask, found.centreDn, found.model.darkestDn, found.model.brightestDn - found.model.darkestDn
    };
    found.isOffsetDrift = IsOffsetDrift(data);
    if (!found.isOffsetDrift)
    {
      found.localOffset = FindLocalOffset(data);
    }
    found.localFlicker = SumLocalFlicker(data);
  }
}

} // namespace sensornoise

#endif
