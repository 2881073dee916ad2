// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/ReestimatedComponents.h"

#include "pixels/IlluminationResponses.h"
#include "series/FrameEquations.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the effect of the noise on the equations of the frames, by the fitted \a line and the offset \a offsetDn
 * [DN]. */
RegressorNoise
NoiseOfLine(const FrameRegressors & regressors,
            const VarianceLine &    line,
            double                  offsetDn,
            const ParallelFor &     parallelFor)
{
  // Sums of the variance and of the shot noise for each class.
  const auto             varianceOf = [](std::size_t gradientClass) { return 2 * gradientClass; };
  const auto             shotOf = [](std::size_t gradientClass) { return 2 * gradientClass + 1; };
  const ReferenceFrame & frame = regressors.GetFrame();
  const auto sums = SumOverBlocks<2 * GradientClasses>(frame.mean.size(), parallelFor, [&](std::size_t p, auto & s) {
    const std::size_t c = regressors.ClassOf(p);
    if (c != FrameRegressors::Unused)
    {
      const double level = frame.neighbourMean[p];
      const double variance = line.At(level);
      const double w = 1.0 / regressors.GetModel().NoiseVariance(level);
      s[varianceOf(c)] += w * variance;
      s[shotOf(c)] += w * line.gain * std::max(0.0, level - offsetDn);
    }
  });
  RegressorNoise noise;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    noise.variance[c] = sums[varianceOf(c)];
    noise.shot[c] = sums[shotOf(c)];
  }
  return noise;
}
} // namespace

ReestimatedComponents
ReestimateComponents(const FrameSums &        sums,
                     const SceneSeries &      series,
                     const PixelCoordinates & coordinates,
                     const StaticVariance &   variance,
                     const ParallelFor &      parallelFor)
{
  const InitialNoiseModel &   model = sums.GetRegressors().GetModel();
  const std::vector<double> & gamma = series.line.gamma;
  const RegressorNoise        noise =
    NoiseOfLine(sums.GetRegressors(), variance.line, series.offset + model.centreDn, parallelFor);
  ReestimatedComponents reestimated;
  reestimated.line = FitOffsetLine(sums, noise, gamma).value_or(series.line);
  if (!reestimated.line.DeterminesOffset())
  {
    reestimated.line.UseOffset(series.offset);
  }
  const FrameEquations            equations = MakeFrameEquations(sums, noise, GradientClasses - 1, gamma);
  const std::optional<OffsetLine> everywhere = FitOffsetLine(equations);
  reestimated.motionPhi = everywhere ? everywhere->Widening() : 1.0;
  reestimated.motion = SolveMotion(equations, reestimated.line.gamma, reestimated.line.offset);
  reestimated.shifts = SolveShifts(sums,
                                   equations,
                                   reestimated.motion,
                                   sums.NoiseOfInstruments(variance.line.gain, variance.line.intercept),
                                   reestimated.line.gamma,
                                   reestimated.line.offset);
  if (series.local.series.cols() > 0)
  {
    const IlluminationResponses light{
      sums.GetFrame(), coordinates,     series.basis.NumberOfIlluminationFactors(), variance.line, variance.mask,
      model.centreDn,  model.darkestDn, model.brightestDn - model.darkestDn
    };
    reestimated.isOffsetDrift = IsOffsetDrift(light);
    if (!reestimated.isOffsetDrift)
    {
      reestimated.localOffset = FindLocalOffset(light, parallelFor);
    }
    reestimated.localFlicker = SumLocalFlicker(light);
  }
  return reestimated;
}

} // namespace sensornoise
