// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_NeighbourExchange_h
#define sensornoise_simulation_NeighbourExchange_h

#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

#include <cstddef>

namespace sensornoise
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

} // namespace sensornoise

#endif
