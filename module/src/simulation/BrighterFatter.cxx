// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/BrighterFatter.h"

#include "simulation/NeighbourExchange.h"
#include "simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const BrighterFatterSettings & settings, double electrons)
{
  RequireNotNegative(settings.perElectron, "brighter-fatter coefficient");
  // A bright pixel among dark ones loses up to twice this fraction; beyond it the first order is not accurate.
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
