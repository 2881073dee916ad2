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
#ifndef sensornoise_report_Quantities_h
#define sensornoise_report_Quantities_h

#include "sensornoise/report/Report.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace sensornoise
{

/** A number as people read it. */
inline std::string
Text(double number)
{
  std::ostringstream text;
  text.precision(6);
  text << number;
  return text.str();
}

/** A value with its standard error and 95 % interval. */
inline Quantity
WithError(double value, double standardError, std::string unit, double student = 1.96)
{
  Quantity quantity = Quantity::Identified(value, std::move(unit));
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - student * standardError, value + student * standardError };
  return quantity;
}

/** What is not distinguishable from 0: no value, and an interval up to \a high. */
inline Quantity
UpperLimit(double high, std::string unit)
{
  Quantity quantity = Quantity::Without(EstimateStatus::UpperLimit, std::move(unit));
  quantity.interval95 = Interval{ 0.0, high };
  quantity.bracket = quantity.interval95;
  return quantity;
}

/** A root of a squared quantity: its interval is the root of the square's, cut at 0; an interval that holds 0 gives an
 * upper limit and no value, and noise that carried the square below 0 does not lower it. */
inline Quantity
RootOf(double square, double standardError, std::string unit, double student = 1.96)
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
/** Marks every parameter of the sensor \a status, without a value. */
inline void
SetSensorParameters(Report & report, EstimateStatus status)
{
  for (Quantity * quantity : { &report.gain,
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

#endif
