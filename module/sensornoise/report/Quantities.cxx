// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sensornoise
{

Quantity
WithError(double value, double standardError, std::string unit, double student)
{
  Quantity quantity = Quantity::Identified(value, std::move(unit));
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - student * standardError, value + student * standardError };
  return quantity;
}

Quantity
UpperLimit(double high, std::string unit)
{
  Quantity quantity = Quantity::Without(EstimateStatus::UpperLimit, std::move(unit));
  quantity.interval95 = Interval{ 0.0, high };
  quantity.bracket = quantity.interval95;
  return quantity;
}

Quantity
RootOf(double square, double standardError, std::string unit, double student)
{
  const double high = std::sqrt(std::max(0.0, square) + student * standardError);
  if (!(square - student * standardError > 0.0))
  {
    return UpperLimit(high, std::move(unit));
  }
  const double value = std::sqrt(square);
  Quantity     quantity = WithError(value, standardError / (2.0 * value), std::move(unit));
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
    *quantity = Quantity::Without(status, quantity->unit);
  }
}

} // namespace sensornoise
