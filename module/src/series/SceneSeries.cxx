// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/SceneSeries.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/NothingToMeasure.h"
#include "scene/InitialNoiseModel.h"
#include "series/Constants.h"
#include "series/FrameProducts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sensornoise
{

namespace
{
/** Returns the level of the darkest frame, minus the centre [DN]: the highest offset that the frames allow. */
double
LevelOfDarkestFrame(OffsetLine line, double offset)
{
  line.UseOffset(offset);
  const double darkest = *std::min_element(line.gamma.begin(), line.gamma.end());
  return -offset * darkest;
}
} // namespace

RegressorNoise
NoiseOfModel(const FrameRegressors & regressors)
{
  RegressorNoise noise;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    noise.variance[c] = regressors.PixelsOfClass(c);
  }
  return noise;
}

SceneSeries
FindSceneSeries(const FrameSums &             sums,
                RollingShutter                rollingShutter,
                const std::optional<double> & knownOffsetDn,
                double                        blackDn,
                bool                          changesStrongly)
{
  const RegressorNoise            noise = NoiseOfModel(sums.GetRegressors());
  const std::optional<OffsetLine> line = FitOffsetLine(sums, noise);
  if (!line)
  {
    double pixels = 0.0;
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      pixels += sums.GetRegressors().PixelsOfClass(c);
    }
    throw NothingToMeasure(
      pixels > 0.0 ? "the usable pixels all have one intensity, which determines neither gain nor offset. Include "
                     "dark and bright areas in the scene"
                   : "no pixel is left: all are masked, clipped, next to a clip level or in moving areas. "
                     "Record a static scene between the clip levels, or correct --mask, --roi or --clip");
  }
  SceneSeries found;
  found.line = *line;
  const InitialNoiseModel & model = sums.GetRegressors().GetModel();
  if (!changesStrongly) // the deviations of a non-linear response from the line are larger then
  {
    found.frameOffsets =
      FindFrameOffsets(*line,
                       { std::min(blackDn, model.darkestDn) - model.centreDn, model.darkestDn - model.centreDn, 2 },
                       InSeries.leastOffsetStep * std::sqrt(model.NoiseVariance(model.darkestDn)));
  }
  FrameEquations equations = MakeFrameEquations(sums, noise, GradientClasses - 1);
  // Fixed-pattern noise of a flat field has contrast, too.
  const bool isPrecise =
    line->standardError < InCommon.largestRelativeError * std::max(0.0, -line->offset) || !changesStrongly;
  found.isOffsetIdentifiable = line->DeterminesOffset() && isPrecise;
  const bool   hasLevels = line->contrast > InSeries.leastContrast;
  const double fallbackDn = hasLevels ? model.darkestDn : std::min(blackDn, model.darkestDn);
  found.offset = found.isOffsetIdentifiable ? line->offset : knownOffsetDn.value_or(fallbackDn) - model.centreDn;
  if (!found.isOffsetIdentifiable && !knownOffsetDn && changesStrongly)
  {
    found.offset = LevelOfDarkestFrame(found.line, found.offset);
  }
  if (!found.isOffsetIdentifiable)
  {
    found.line.UseOffset(found.offset);
  }
  const bool isFlat = changesStrongly && !hasLevels;
  if (isFlat)
  {
    equations.active.resize(2); // derivatives of one level are noise, and so would be their series
  }
  found.motion = SolveMotion(equations, found.line.gamma, found.offset);
  const Eigen::MatrixXd motionColumns = MotionColumns(found.motion, found.line.gamma);
  const std::size_t     most =
    rollingShutter == RollingShutter::Off || isFlat
          ? 0
          : std::min<std::size_t>(InSeries.mostLocalSeries, (sums.GetFrame().frames - 1) / InSeries.framesPerLocalSeries);
  found.local = FindLocalIllumination(sums, found.motion, motionColumns, found.line.gamma, found.offset, most);
  found.basis = TemporalBasis(found.line.gamma, found.local.series, motionColumns);
  return found;
}

} // namespace sensornoise
