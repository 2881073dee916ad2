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
#include "sensornoise/correlation/CorrelationRecord.h"

#include "sensornoise/report/Quantities.h"

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
  if (variance.value < LeastLineNoiseZ * variance.standardError)
  {
    return UpperLimit(std::sqrt(std::max(0.0, variance.value) + 2.0 * variance.standardError), "DN");
  }
  return RootOf(variance.value, variance.standardError, "DN", 2.0);
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
  record.rowNoise = LineNoise(correlation.rowsDn2);
  record.columnNoise = LineNoise(correlation.columnsDn2);
  record.excessKurtosis =
    WithError(correlation.kurtosis.front().value, correlation.kurtosis.front().standardError, "1", 2.0);
  return record;
}

} // namespace sensornoise
