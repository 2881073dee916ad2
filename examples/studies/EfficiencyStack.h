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
#ifndef EfficiencyStack_h
#define EfficiencyStack_h

#include "sensornoise/simulation/SimulationSettings.h"
#include "studies/EfficiencyStatistics.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** A reference image. */
struct Scene
{
  std::size_t         width;
  std::size_t         height;
  std::vector<double> values;
};

/** Simulates a stack, measures it by the method "refined" or "published", and works out how well it could be measured:
 * by the Cramer-Rao bound or by its closed forms, for the pixels that no clipping touches. Experiment and seed are for
 * the record. */
EfficiencyRun
MeasureStack(const Scene &              scene,
             const SimulationSettings & settings,
             const std::string &        methodName,
             bool                       isFullBound);

} // namespace sensornoise::tools

#endif
