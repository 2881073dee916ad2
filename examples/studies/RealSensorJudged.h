// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorJudged_h
#define RealSensorJudged_h

#include "sensornoise/Report.h"

#include <cstddef>
#include <optional>

namespace sensornoise::tools
{

/** What is judged, in the order of the table. */
enum class JudgedQuantity : std::size_t
{
  Gain,
  Offset,
  Flicker,
  ReadNoise,
  ReadNoiseMedian,
  RowNoise,
  ColumnNoise
};
inline constexpr std::size_t NumberOfJudged = 7;

/** The name as the table prints it. */
const char *
NameOf(JudgedQuantity quantity);

/** An estimate and its truth. */
struct Judged
{
  double   truth{ 0.0 };
  Quantity estimate;

  bool
  IsIdentified() const
  {
    return estimate.status == EstimateStatus::Identified && estimate.value;
  }
  /** Whether the 95 % interval holds the truth; null unless it is identified. No interval holds nothing. */
  std::optional<bool>
  Holds() const;

  /** Whether the limit of what cannot be told from zero is above the truth; null for any other status. */
  std::optional<bool>
  LimitHolds() const;

  /** Whether the physical limits hold the truth; null where there are none. */
  std::optional<bool>
  BracketHolds() const;

  /** Whether the value lies within its own physical limits; null without value or limits. */
  std::optional<bool>
  IsInBracket() const;

  /** Error over standard error; null if either is missing. */
  std::optional<double>
  Z() const;

  /** Whether it is identified, and off by no more than \a fraction of the truth or three standard errors. */
  bool
  IsWithin(double fraction) const;
};

} // namespace sensornoise::tools

#endif
