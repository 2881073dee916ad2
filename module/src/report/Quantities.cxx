// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sensornoise
{

namespace
{
/** Whether two intervals have a number in common; an end that is missing is not bounded. */
bool
Overlap(const Interval & a, const Interval & b)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return a.low.value_or(-infinity) <= b.high.value_or(infinity) &&
         b.low.value_or(-infinity) <= a.high.value_or(infinity);
}

Quantity
FiledPositive(const Quantity & quantity, bool mayBeZero)
{
  const Interval & interval = *quantity.interval95;
  const double     low = interval.low.value_or(0.0);
  if (low > 0.0 && quantity.standardError.value_or(0.0) <= LargestRelativeError * *quantity.value)
  {
    return quantity;
  }
  if (mayBeZero && !(low > 0.0) && interval.high)
  {
    return UpperLimit(*interval.high);
  }
  const Interval known{ std::max(0.0, low), interval.high };
  return Quantity::Without(EstimateStatus::NotIdentifiable, quantity.bracket ? quantity.bracket : known);
}

Quantity
FiledOffset(const Quantity & quantity, double signalDn)
{
  if (!quantity.interval95)
  {
    return quantity;
  }
  const Interval & interval = *quantity.interval95;
  if (quantity.bracket && !Overlap(interval, *quantity.bracket))
  {
    return Quantity::Without(EstimateStatus::Failed, quantity.bracket);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double     width = interval.high.value_or(infinity) - interval.low.value_or(-infinity);
  return width <= LargestOffsetInterval * signalDn
           ? quantity
           : Quantity::Without(EstimateStatus::NotIdentifiable, quantity.bracket ? quantity.bracket : interval);
}
} // namespace

Quantity
Filed(const Quantity & quantity, QuantityDomain domain, double signalDn)
{
  if (quantity.status != EstimateStatus::Identified || !quantity.value)
  {
    return quantity;
  }
  if (domain == QuantityDomain::Offset)
  {
    return FiledOffset(quantity, signalDn);
  }
  if (!quantity.interval95)
  {
    return quantity;
  }
  if (domain != QuantityDomain::AnySign)
  {
    return FiledPositive(quantity, domain == QuantityDomain::NonNegative);
  }
  const bool isBounded = quantity.interval95->low && quantity.interval95->high;
  return isBounded ? quantity : Quantity::Without(EstimateStatus::NotIdentifiable, quantity.interval95);
}

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
  const double value = std::sqrt(std::max(0.0, square));
  Quantity     quantity = WithError(value, standardError / (2.0 * value));
  quantity.interval95 = Interval{ std::sqrt(std::max(0.0, square - student * standardError)),
                                  std::sqrt(std::max(0.0, square) + student * standardError) };
  return Filed(quantity, QuantityDomain::NonNegative);
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
