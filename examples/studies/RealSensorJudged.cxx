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
#include "studies/RealSensorJudged.h"

#include <array>
#include <cmath>

namespace sensornoise::tools
{
namespace
{
bool
IsInside(const Interval & interval, double value)
{
  return value >= interval.low.value_or(value) && value <= interval.high.value_or(value);
}
} // namespace

const char *
NameOf(JudgedQuantity quantity)
{
  static constexpr std::array<const char *, NumberOfJudged> names{
    "gain", "offset", "flicker", "read noise", "median read noise", "row noise", "column noise"
  };
  return names[static_cast<std::size_t>(quantity)];
}

std::optional<bool>
Judged::Holds() const
{
  return IsIdentified() ? std::optional<bool>(estimate.interval95 && IsInside(*estimate.interval95, truth))
                        : std::nullopt;
}

std::optional<bool>
Judged::LimitHolds() const
{
  if (estimate.status != EstimateStatus::UpperLimit)
  {
    return std::nullopt;
  }
  const auto & limit = estimate.bracket ? estimate.bracket : estimate.interval95;
  return limit && limit->high && truth <= *limit->high;
}

std::optional<bool>
Judged::BracketHolds() const
{
  return estimate.bracket ? std::optional<bool>(IsInside(*estimate.bracket, truth)) : std::nullopt;
}

std::optional<bool>
Judged::IsInBracket() const
{
  return IsIdentified() && estimate.bracket ? std::optional<bool>(IsInside(*estimate.bracket, *estimate.value))
                                            : std::nullopt;
}

std::optional<double>
Judged::Z() const
{
  return IsIdentified() && estimate.standardError
           ? std::optional<double>((*estimate.value - truth) / *estimate.standardError)
           : std::nullopt;
}

bool
Judged::IsWithin(double fraction) const
{
  return IsIdentified() &&
         (std::abs(*estimate.value - truth) <= fraction * std::abs(truth) || std::abs(Z().value_or(INFINITY)) <= 3.0);
}

} // namespace sensornoise::tools
