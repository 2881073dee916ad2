// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationRecord.h"

#include "base/Significance.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sensornoise
{

namespace
{
Quantity
LineNoise(const MeasuredNumber & variance)
{
  if (variance.value < Significance.severalTests * variance.standardError)
  {
    return UpperLimit(std::sqrt(std::max(0.0, variance.value) + 2.0 * variance.standardError));
  }
  return RootOf(variance.value, variance.standardError, 2.0);
}
} // namespace

NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation)
{
  NoiseCorrelationRecord record;
  record.kind = NameOf(correlation.kind);
  if (correlation.kind == NoiseKind::NotMeasured)
  {
    return record;
  }
  const auto lagOf = [](const LagCoefficient & lag) {
    return NoiseCorrelationRecord::Lag{
      lag.lag.x, lag.lag.y, lag.lag.t, lag.coefficient.value, lag.coefficient.standardError
    };
  };
  std::transform(correlation.space.begin(), correlation.space.end(), std::back_inserter(record.space), lagOf);
  std::transform(correlation.time.begin(), correlation.time.end(), std::back_inserter(record.time), lagOf);
  for (const CovarianceLine & line : correlation.covarianceLines)
  {
    record.covarianceLines.push_back({ line.lag.x,
                                       line.lag.y,
                                       line.slopeDn.value,
                                       line.slopeDn.standardError,
                                       line.interceptDn2.value,
                                       line.interceptDn2.standardError });
  }
  record.rowNoise = LineNoise(correlation.rowsDn2);
  record.columnNoise = LineNoise(correlation.columnsDn2);
  record.excessKurtosis =
    WithError(correlation.kurtosis.front().value, correlation.kurtosis.front().standardError, 2.0);
  return record;
}

} // namespace sensornoise
