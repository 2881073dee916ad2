// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ChargeCoupling.h"

#include "simulation/NeighbourExchange.h"
#include "simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const CouplingSettings & settings)
{
  // At 0.2 a pixel keeps no more charge than each of its neighbours receives.
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
