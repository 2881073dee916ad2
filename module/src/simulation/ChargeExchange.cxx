// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ChargeExchange.h"

#include "simulation/SettingChecks.h"

#include <cstddef>

namespace sensornoise
{
namespace
{
/** Adds inflow(charge of the pixel, charge of the neighbour) to every pixel for each of its four neighbours; a pixel at
 * the edge has fewer. If inflow(a, b) = -inflow(b, a), the total charge of the frame is conserved. */
template <typename TInflow>
DoubleFrame
ExchangeWithNeighbours(const DoubleFrame & frame, const ParallelFor & parallelFor, TInflow inflow)
{
  DoubleFrame out(frame.width, frame.height);
  parallelFor(frame.height, [&](std::size_t y) {
    const double * row = frame.Row(y);
    for (std::size_t x = 0; x < frame.width; ++x)
    {
      double sum = row[x];
      sum += x > 0 ? inflow(row[x], row[x - 1]) : 0.0;
      sum += x + 1 < frame.width ? inflow(row[x], row[x + 1]) : 0.0;
      sum += y > 0 ? inflow(row[x], frame.Row(y - 1)[x]) : 0.0;
      sum += y + 1 < frame.height ? inflow(row[x], frame.Row(y + 1)[x]) : 0.0;
      out.Row(y)[x] = sum;
    }
  });
  return out;
}
} // namespace

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
