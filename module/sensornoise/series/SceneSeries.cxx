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
#include "sensornoise/series/SceneSeries.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/series/FrameProducts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sensornoise
{

RegressorNoise
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

SceneSeries
FindSceneSeries(const FrameSums &             sums,
                RollingShutter                rollingShutter,
                const std::optional<double> & knownOffsetDn,
                double                        blackDn)
{
  const RegressorNoise            noise = NoiseOfModel(sums.GetRegressors());
  const std::optional<OffsetLine> line = FitOffsetLine(sums, noise);
  if (!line)
  {
    throw NothingToMeasure("the pixels have one intensity; expected dark and bright areas");
  }
  SceneSeries found;
  found.line = *line;
  const ProvisionalModel & model = sums.GetRegressors().GetModel();
  const FrameEquations     equations = MakeFrameEquations(sums, noise, GradientClasses - 1);
  found.isOffsetTold = line->TellsOffset();
  const bool   hasLevels = line->contrast > OffsetLine::LeastContrast;
  const double fallbackDn = hasLevels ? model.darkestDn : std::min(blackDn, model.darkestDn);
  found.offset = found.isOffsetTold ? line->offset : knownOffsetDn.value_or(fallbackDn) - model.centreDn;
  if (!found.isOffsetTold)
  {
    found.line.UseOffset(found.offset);
  }
  found.motion = SolveMotion(equations, found.line.gamma, found.offset);
  const Eigen::MatrixXd motionColumns = MotionColumns(found.motion, found.line.gamma);
  const std::size_t     most =
    rollingShutter == RollingShutter::Off ? 0 : std::min<std::size_t>(12, (sums.GetFrame().frames - 1) / 6);
  found.local = FindLocalIllumination(sums, found.motion, motionColumns, found.line.gamma, found.offset, most);
  found.basis = TemporalBasis(found.line.gamma, found.local.series, motionColumns);
  return found;
}

} // namespace sensornoise
