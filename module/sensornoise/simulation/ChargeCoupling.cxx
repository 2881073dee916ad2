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
#include "sensornoise/simulation/ChargeCoupling.h"

#include "sensornoise/simulation/NeighbourExchange.h"
#include "sensornoise/simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const CouplingSettings & settings)
{
  // At 0.2 a pixel would keep no more than each of its neighbours gets.
  RequireSetting(
    settings.fraction >= 0.0 && settings.fraction <= 0.2, "coupling of charge", settings.fraction, "0 to 0.2");
}

DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor)
{
  const double fraction = settings.fraction;
  return ExchangeWithNeighbours(
    charge, parallelFor, [fraction](double own, double neighbour) { return fraction * (neighbour - own); });
}

} // namespace sensornoise
