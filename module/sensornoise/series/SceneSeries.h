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
#ifndef sensornoise_series_SceneSeries_h
#define sensornoise_series_SceneSeries_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/RequiredFlickerZ.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/pixels/LocalFlicker.h"
#include "sensornoise/pixels/LocalOffset.h"
#include "sensornoise/pixels/PixelLight.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/FrameEquations.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameRegressors.h"
#include "sensornoise/series/FrameSums.h"
#include "sensornoise/series/LocalIllumination.h"
#include "sensornoise/series/MotionSeries.h"
#include "sensornoise/series/OffsetLine.h"
#include "sensornoise/series/ShiftInstruments.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

namespace detail
{
/** What the noise does to the equations of the frames, and to the instruments. */
struct SeriesNoise
{
  RegressorNoise  regressors;
  InstrumentNoise instruments;
};

/** The noise by the provisional model itself, by which w V = 1. */
inline RegressorNoise
NoiseOfModel(const FrameRegressors & regressors)
{
  RegressorNoise noise;
  for (std::size_t p = 0; p < regressors.GetFrame().mean.size(); ++p)
  {
    if (regressors.ClassOf(p) != FrameRegressors::Unused)
    {
      noise.variance[regressors.ClassOf(p)] += 1.0;
    }
  }
  return noise;
}

/** The noise by the line that was fitted, about the offset \a offsetDn. */
inline SeriesNoise
NoiseOfLine(const FrameRegressors & regressors,
            const VarianceLine &    line,
            double                  offsetDn,
            const ParallelFor &     parallelFor)
{
  constexpr std::size_t  classes = GradientClasses;
  const ReferenceFrame & frame = regressors.GetFrame();
  const auto  sums = SumOverBlocks<2 * classes + 4>(frame.mean.size(), parallelFor, [&](std::size_t p, auto & s) {
    const std::size_t c = regressors.ClassOf(p);
    if (c != FrameRegressors::Unused)
    {
      const double level = frame.neighbourMean[p];
      const double variance = line.At(level);
      const double w = 1.0 / regressors.GetModel().NoiseVariance(level);
      const double x = regressors.InstrumentX(p);
      const double y = regressors.InstrumentY(p);
      s[2 * c] += w * variance;
      s[2 * c + 1] += w * line.gain * std::max(0.0, level - offsetDn);
      s[2 * classes] += regressors.InstrumentWeight(p) * variance;
      s[2 * classes + 1] += variance * x * x;
      s[2 * classes + 2] += variance * x * y;
      s[2 * classes + 3] += variance * y * y;
    }
  });
  SeriesNoise noise;
  for (std::size_t c = 0; c < classes; ++c)
  {
    noise.regressors.variance[c] = sums[2 * c];
    noise.regressors.shot[c] = sums[2 * c + 1];
  }
  const double * products = sums.data() + 2 * classes;
  noise.instruments.variance = products[0];
  noise.instruments.squares << products[1], products[2], products[2], products[3];
  return noise;
}
} // namespace detail

/** What changes from frame to frame beside the noise: flicker, local light and motion, from the sums of the second
 * pass. The noise is the provisional model's. Returns the basis of the third pass. Throws std::runtime_error if the
 * pixels have one intensity. */
inline TemporalBasis
FindSceneSeries(const FrameSums & sums, RollingShutter rollingShutter, RefinedFindings & found)
{
  const RegressorNoise            noise = detail::NoiseOfModel(sums.GetRegressors());
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
                  RefinedFindings &                 found,
                  const ParallelFor &               parallelFor)
{
  const VarianceLine &            line = found.variance;
  const double                    offsetDn = found.offsetInUse + found.centreDn;
  const detail::SeriesNoise       noise = detail::NoiseOfLine(sums.GetRegressors(), line, offsetDn, parallelFor);
  const std::vector<double>       gamma = found.line.gamma;
  const std::optional<OffsetLine> polished = FitOffsetLine(sums, noise.regressors, gamma);
  found.line = polished ? *polished : found.line;
  const FrameEquations            equations = MakeFrameEquations(sums, noise.regressors, GradientClasses - 1, gamma);
  const std::optional<OffsetLine> everywhere = FitOffsetLine(equations);
  found.motionPhi = everywhere ? everywhere->Widening() : 1.0;
  found.motion = SolveMotion(equations, found.line.gamma, found.line.offset);
  found.shifts = SolveShifts(sums, found.motion, noise.instruments, found.line.gamma, found.line.offset);
  if (found.local.series.cols() > 0)
  {
    const PixelLight data{
      projected, line, mask, found.centreDn, found.model.darkestDn, found.model.brightestDn - found.model.darkestDn
    };
    found.isOffsetDrift = IsOffsetDrift(data);
    if (!found.isOffsetDrift)
    {
      found.localOffset = FindLocalOffset(data, parallelFor);
    }
    found.localFlicker = SumLocalFlicker(data);
  }
}

} // namespace sensornoise

#endif
