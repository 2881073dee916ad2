// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
