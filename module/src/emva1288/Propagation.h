// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_Propagation_h
#define sensornoise_emva1288_Propagation_h

#include "moments/ExposureFit.h"
#include "report/Quantities.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

/** Returns the value of \a function of the numbers with its standard error, as a quantity above 0. The errors of the
 * numbers are independent. Each contributes half of the difference of the function between one standard error above and
 * below the number. */
template <typename TFunction, std::size_t VNumbers>
Quantity
Propagate(TFunction function, const std::array<FittedNumber, VNumbers> & numbers)
{
  std::array<double, VNumbers> values{};
  for (std::size_t k = 0; k < VNumbers; ++k)
  {
    values[k] = numbers[k].value;
  }
  double variance = 0.0;
  for (std::size_t k = 0; k < VNumbers; ++k)
  {
    std::array<double, VNumbers> up = values;
    std::array<double, VNumbers> down = values;
    up[k] += numbers[k].standardError;
    down[k] -= numbers[k].standardError;
    const double change = 0.5 * (function(up) - function(down));
    variance += change * change;
  }
  return Filed(WithError(function(values), std::sqrt(variance)), QuantityDomain::Positive);
}

/** Returns value and standard error of an identified quantity; the error is 0 if it is not known. */
inline FittedNumber
NumberOf(const Quantity & quantity)
{
  return { quantity.value.value_or(0.0), quantity.standardError.value_or(0.0) };
}

} // namespace sensornoise

#endif
