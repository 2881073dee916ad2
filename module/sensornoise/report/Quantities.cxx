// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/Quantities.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

Quantity
WithError(double value, double standardError, double student)
{
  Quantity quantity = Quantity::Identified(value);
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - student * standardError, value + student * standardError };
  return quantity;
}

Quantity
UpperLimit(double high)
{
  Quantity quantity = Quantity::Without(EstimateStatus::UpperLimit);
  quantity.interval95 = Interval{ 0.0, high };
  quantity.bracket = quantity.interval95;
  return quantity;
}

Quantity
RootOf(double square, double standardError, double student)
{
  const double high = std::sqrt(std::max(0.0, square) + student * standardError);
  if (!(square - student * standardError > 0.0))
  {
    return UpperLimit(high);
  }
  const double value = std::sqrt(square);
  Quantity     quantity = WithError(value, standardError / (2.0 * value));
  quantity.interval95 = Interval{ std::sqrt(square - student * standardError), high };
  return quantity;
}

void
SetSensorParameters(Report & report, EstimateStatus status)
{
  for (Quantity * quantity : { &report.gain,
                               &report.varianceSlope,
                               &report.offset,
                               &report.readNoise,
                               &report.readNoiseElectrons,
                               &report.intercept,
                               &report.totalIntercept })
  {
    *quantity = Quantity::Without(status);
  }
}

} // namespace sensornoise
