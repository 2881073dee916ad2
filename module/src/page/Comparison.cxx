// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Comparison.h"

#include "base/ChiSquare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
bool
IsOffset(const QuantityEntry & entry)
{
  return std::string(entry.path) == "offset";
}

/** Returns the value; none if it is NaN or beyond ExtremeValue. */
std::optional<double>
FiniteValue(const Quantity & quantity)
{
  return quantity.value && std::abs(*quantity.value) <= ExtremeValue ? quantity.value : std::nullopt;
}

/** Returns the standard error of a value; none if it is 0, as for a given offset, or beyond ExtremeValue. */
std::optional<double>
ErrorOf(const Quantity & quantity)
{
  const std::optional<double> & error = quantity.standardError;
  return quantity.value && error && *error >= 1.0 / ExtremeValue && *error <= ExtremeValue ? error : std::nullopt;
}

/** Returns the value with which a difference of \a entry is compared: the magnitude of the first value, for the offset
 * the first read noise. None if it does not exceed twice its error. */
std::optional<double>
ScaleOf(const QuantityEntry & entry, const Report & first)
{
  const Quantity & scale = IsOffset(entry) ? first.readNoise : *entry.of(first);
  const auto       value = FiniteValue(scale);
  const bool       isSure = value && std::abs(*value) > 2.0 * ErrorOf(scale).value_or(0.0);
  return isSure ? std::optional<double>(std::abs(*value)) : std::nullopt;
}

ChangeKind
KindOfChange(const Change & change, bool isOffset)
{
  if (!change.standardError)
  {
    return ChangeKind::NoErrors;
  }
  if (std::abs(*change.difference) <= ChanceErrors * *change.standardError)
  {
    return ChangeKind::Within;
  }
  const bool isSmall = change.fraction && std::abs(*change.fraction) < (isOffset ? SmallOffsetFraction : SmallFraction);
  return isSmall ? ChangeKind::Small : ChangeKind::Changed;
}

Change
Compare(const QuantityEntry & entry, const std::vector<ComparedReport> & rows, std::size_t first, std::size_t row)
{
  Change change;
  change.first = first;
  const Quantity & before = *entry.of(rows[first].report);
  const Quantity & now = *entry.of(rows[row].report);
  if (first == row)
  {
    change.kind = ChangeKind::First;
    return change;
  }
  if (!FiniteValue(before) || !FiniteValue(now))
  {
    return change;
  }
  change.difference = *now.value - *before.value;
  if (const auto scale = ScaleOf(entry, rows[first].report))
  {
    change.fraction = *change.difference / *scale;
  }
  if (ErrorOf(before) && ErrorOf(now))
  {
    change.standardError = std::hypot(*before.standardError, *now.standardError);
  }
  change.kind = KindOfChange(change, IsOffset(entry));
  return change;
}

/** Returns the first row with the channel of \a row. */
std::size_t
FirstOf(const std::vector<ComparedReport> & rows, std::size_t row)
{
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ComparedReport & other) {
    return other.report.channel == rows[row].report.channel;
  });
  return static_cast<std::size_t>(std::distance(rows.begin(), found));
}

/** Returns the weighted mean of \a values, which have errors above 0, and the chi-square of their scatter. The channel
 * is left empty. */
CommonMean
MeanOf(const std::vector<Quantity> & values)
{
  double weights = 0.0;
  double squares = 0.0;
  double sum = 0.0;
  for (const Quantity & quantity : values)
  {
    const double weight = 1.0 / (*quantity.standardError * *quantity.standardError);
    weights += weight;
    squares += weight * weight;
    sum += weight * *quantity.value;
  }
  CommonMean common;
  common.count = values.size();
  common.mean = sum / weights;
  common.standardError = 1.0 / std::sqrt(weights);
  for (const Quantity & quantity : values)
  {
    const double errors = (*quantity.value - common.mean) / *quantity.standardError;
    common.chiSquare += errors * errors;
  }
  const auto dof = static_cast<double>(values.size() - 1);
  common.probability = ChiSquareUpper(common.chiSquare, dof);
  common.excess = std::sqrt(std::max(0.0, (common.chiSquare - dof) / (weights - squares / weights)));
  return common;
}

/** Returns the weighted means of a quantity, for each channel with three or more values that have errors. */
std::vector<CommonMean>
MeansOf(const QuantityEntry & entry, const std::vector<ComparedReport> & rows)
{
  std::vector<CommonMean> means;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    if (FirstOf(rows, row) != row)
    {
      continue;
    }
    std::vector<Quantity> values;
    for (const ComparedReport & other : rows)
    {
      const Quantity & quantity = *entry.of(other.report);
      if (other.report.channel == rows[row].report.channel && FiniteValue(quantity) && ErrorOf(quantity))
      {
        values.push_back(quantity);
      }
    }
    if (values.size() >= 3)
    {
      means.push_back(MeanOf(values));
      means.back().channel = rows[row].report.channel;
    }
  }
  return means;
}

/** Returns whether \a entry is the variance slope and equals the gain in all reports, as with white noise and uniform
 * quantization. It then adds no information. */
bool
IsTheGain(const QuantityEntry & entry, const std::vector<ComparedReport> & rows)
{
  return entry.shown == ShownIn::TableIfNotTheGain &&
         std::all_of(rows.begin(), rows.end(), [&entry](const ComparedReport & row) {
           return !entry.of(row.report)->value || entry.of(row.report)->value == row.report.gain.value;
         });
}
} // namespace

Comparison
MakeComparison(std::vector<ComparedReport> rows)
{
  constexpr std::array<const char *, 6> compared{ "gain",   "read_noise",     "read_noise_electrons",
                                                  "offset", "variance_slope", "total_intercept" };
  Comparison                            comparison;
  comparison.rows = std::move(rows);
  for (const char * const path : compared)
  {
    const auto & list = QuantityList();
    const auto   entry = std::find_if(
      list.begin(), list.end(), [path](const QuantityEntry & each) { return each.path == std::string(path); });
    if (IsTheGain(*entry, comparison.rows))
    {
      continue;
    }
    ComparedQuantity quantity;
    quantity.entry = &*entry;
    for (std::size_t row = 0; row < comparison.rows.size(); ++row)
    {
      quantity.changes.push_back(Compare(*entry, comparison.rows, FirstOf(comparison.rows, row), row));
    }
    quantity.means = MeansOf(*entry, comparison.rows);
    comparison.quantities.push_back(std::move(quantity));
  }
  return comparison;
}

} // namespace sensornoise
