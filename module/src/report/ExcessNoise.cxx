// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/ExcessNoise.h"

#include "base/Text.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace sensornoise
{

namespace
{
void
Multiply(std::optional<double> & number, double factor)
{
  if (number)
  {
    *number *= factor;
  }
}

void
Multiply(std::optional<Interval> & interval, double factor)
{
  if (interval)
  {
    Multiply(interval->low, factor);
    Multiply(interval->high, factor);
  }
}

void
Multiply(Quantity & quantity, double factor)
{
  Multiply(quantity.value, factor);
  Multiply(quantity.standardError, factor);
  Multiply(quantity.interval95, factor);
  Multiply(quantity.bracket, factor);
}
} // namespace

void
ValidateExcessNoiseFactor(double factor)
{
  if (!(factor >= 1.0 && std::isfinite(factor)))
  {
    throw std::invalid_argument("the excess noise factor is " + Text(factor) +
                                "; expected a number of 1 or more, 2 for an EMCCD");
  }
}

void
DivideExcessNoise(Report & report, double factor)
{
  if (factor == 1.0)
  {
    return;
  }
  report.settings.emplace_back("excess_noise_factor", factor);
  Multiply(report.gain, 1.0 / factor);
  Multiply(report.readNoiseElectrons, factor);
  for (GainByPartsRecord & record : report.gainByParts)
  {
    for (GainByPartsRecord::Part & part : record.parts)
    {
      part.gain /= factor;
      part.standardError /= factor;
    }
  }
  if (report.covariance)
  {
    auto & covariance = *report.covariance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      covariance[0][k] /= factor;
      covariance[k][0] /= factor;
    }
  }
}

} // namespace sensornoise
