// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseModel.h"

#include "base/Text.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
const char *
StatusWord(EstimateStatus status)
{
  return status == EstimateStatus::NotIdentifiable ? "not identifiable"
         : status == EstimateStatus::UpperLimit    ? "an upper limit only"
                                                   : "failed";
}

double
ValueOf(const Quantity & quantity, const std::string & name)
{
  if (!quantity.value)
  {
    throw std::invalid_argument("the report's " + name + " has no value (it is " + StatusWord(quantity.status) +
                                "); expected a report that has variance_slope and total_intercept");
  }
  return *quantity.value;
}
} // namespace

void
NoiseModel::Validate() const
{
  if (!(std::isfinite(varianceSlopeDn) && varianceSlopeDn > 0.0))
  {
    throw std::invalid_argument("the variance slope is " + Text(varianceSlopeDn) +
                                "; expected a finite number above 0 [DN/e-], the report's variance_slope");
  }
  if (!std::isfinite(totalInterceptDn2))
  {
    throw std::invalid_argument("the total intercept is " + Text(totalInterceptDn2) +
                                "; expected a finite number [DN^2], the report's total_intercept");
  }
}

NoiseModel
NoiseModelOf(const Report & report)
{
  const NoiseModel model{ ValueOf(report.varianceSlope, "variance_slope"),
                          ValueOf(report.totalIntercept, "total_intercept") };
  model.Validate();
  return model;
}

} // namespace sensornoise
