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
#include "sensornoise/simulation/BrighterFatter.h"

#include "sensornoise/simulation/NeighbourExchange.h"
#include "sensornoise/simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const BrighterFatterSettings & settings, double electrons)
{
  RequireNotNegative(settings.perElectron, "brighter-fatter coefficient");
  // A bright pixel among dark ones gives away up to twice this fraction; beyond, the first order says little.
  RequireSetting(settings.perElectron * electrons <= 0.1,
                 "brighter-fatter coefficient times the electrons of the brightest pixel",
                 settings.perElectron * electrons,
                 "at most 0.1");
}

DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor)
{
  const double half = 0.5 * settings.perElectron;
  return ExchangeWithNeighbours(
    charge, parallelFor, [half](double own, double neighbour) { return half * (neighbour - own) * (neighbour + own); });
}

} // namespace sensornoise
