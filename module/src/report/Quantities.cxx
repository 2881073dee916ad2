// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/Quantities.h"

#include "base/Text.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace sensornoise
{

namespace
{
/** Returns whether two intervals overlap. A bound that is null is infinite. */
bool
Overlap(const Interval & a, const Interval & b)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return a.low.value_or(-infinity) <= b.high.value_or(infinity) &&
         b.low.value_or(-infinity) <= a.high.value_or(infinity);
}

/** Returns a positive quantity with its final status; \a mayBeZero: 0 is one of its possible values. */
Quantity
FiledPositive(const Quantity & quantity, bool mayBeZero)
{
  const Interval & interval = *quantity.interval95;
  const double     low = interval.low.value_or(0.0);
  if (low > 0.0 && quantity.standardError.value_or(0.0) <= LargestRelativeError * *quantity.value)
  {
    return quantity;
  }
  if (mayBeZero && !(low > 0.0) && interval.high)
  {
    return UpperLimit(*interval.high);
  }
  const Interval known{ std::max(0.0, low), interval.high };
  return Quantity::Without(EstimateStatus::NotIdentifiable, quantity.bracket ? quantity.bracket : known);
}

/** Returns a dark offset with its final status. \a signalDn is the signal of the brightest pixels [DN]. */
Quantity
FiledOffset(const Quantity & quantity, double signalDn)
{
  if (!quantity.interval95)
  {
    return quantity;
  }
  const Interval & interval = *quantity.interval95;
  if (quantity.bracket && !Overlap(interval, *quantity.bracket))
  {
    return Quantity::Without(EstimateStatus::Failed, quantity.bracket);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double     width = interval.high.value_or(infinity) - interval.low.value_or(-infinity);
  return width <= LargestOffsetInterval * signalDn
           ? quantity
           : Quantity::Without(EstimateStatus::NotIdentifiable, quantity.bracket ? quantity.bracket : interval);
}
} // namespace

Quantity
Filed(const Quantity & quantity, QuantityDomain domain, double signalDn)
{
  if (quantity.status != EstimateStatus::Identified || !quantity.value)
  {
    return quantity;
  }
  if (domain == QuantityDomain::Offset)
  {
    return FiledOffset(quantity, signalDn);
  }
  if (!quantity.interval95)
  {
    return quantity;
  }
  if (domain != QuantityDomain::AnySign)
  {
    return FiledPositive(quantity, domain == QuantityDomain::NonNegative);
  }
  const bool isBounded = quantity.interval95->low && quantity.interval95->high;
  return isBounded ? quantity : Quantity::Without(EstimateStatus::NotIdentifiable, quantity.interval95);
}

Quantity
WithError(double value, double standardError, double student)
{
  Quantity quantity = Quantity::Identified(value);
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - student * standardError, value + student * standardError };
  return quantity;
}

Quantity
UpperLimit(double high)
{
  Quantity quantity = Quantity::Without(EstimateStatus::UpperLimit);
  quantity.interval95 = Interval{ 0.0, high };
  quantity.bracket = quantity.interval95;
  return quantity;
}

Quantity
RootOf(double square, double standardError, double student)
{
  const double value = std::sqrt(std::max(0.0, square));
  Quantity     quantity = WithError(value, standardError / (2.0 * value));
  quantity.interval95 = Interval{ std::sqrt(std::max(0.0, square - student * standardError)),
                                  std::sqrt(std::max(0.0, square) + student * standardError) };
  return Filed(quantity, QuantityDomain::NonNegative);
}

void
SetSensorParameters(Report & report, EstimateStatus status)
{
  for (Quantity * quantity : { &report.gain,
                               &report.varianceSlope,
                               &report.offset,
                               &report.readNoise,
                               &report.readNoiseElectrons,
                               &report.intercept,
                               &report.totalIntercept })
  {
    *quantity = Quantity::Without(status);
  }
}

namespace
{
/** Warnings that contradict the dark offset, and with it the read noise. */
constexpr std::array AgainstDarkLevel{ WarningCode::DarkFramesDiffer,
                                       WarningCode::OffsetOutOfRange,
                                       WarningCode::OffsetAboveDarkest,
                                       WarningCode::OffsetLineMisfit };

/** Replaces the value of an identified quantity, or its upper limit, by a status without a value. */
void
WithdrawIfIdentified(Quantity & quantity, EstimateStatus status)
{
  if (quantity.status == EstimateStatus::Identified || quantity.status == EstimateStatus::UpperLimit)
  {
    quantity = Quantity::Without(status, quantity.bracket);
  }
}

/** Withdraws the quantities that depend on the offset: the read noise, and the covariances of the offset. */
void
WithdrawReadNoise(Report & report, EstimateStatus status)
{
  for (Quantity * const quantity : { &report.readNoise, &report.readNoiseMedian, &report.readNoiseElectrons })
  {
    WithdrawIfIdentified(*quantity, status);
  }
  if (report.covariance)
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < 3; ++k)
    {
      (*report.covariance)[k][2] = (*report.covariance)[2][k] = unknown;
    }
  }
}

/** Withdraws offset and read noise if a warning contradicts them. */
void
WithdrawDarkLevel(Report & report)
{
  const bool isContradicted = std::any_of(report.warnings.begin(), report.warnings.end(), [](const Warning & warning) {
    return std::find(AgainstDarkLevel.begin(), AgainstDarkLevel.end(), warning.code) != AgainstDarkLevel.end();
  });
  if (isContradicted)
  {
    WithdrawIfIdentified(report.offset, EstimateStatus::Failed);
    WithdrawReadNoise(report, EstimateStatus::Failed);
  }
}

/** Withdraws a vibration that is above LargestVibrationPixels. */
void
WithdrawVibration(Report & report)
{
  for (Quantity * const vibration : { &report.vibrationSdX, &report.vibrationSdY })
  {
    if (vibration->value.value_or(0.0) > LargestVibrationPixels)
    {
      *vibration = Quantity::Without(EstimateStatus::Failed);
      report.vibrationCovariance = Quantity::Without(EstimateStatus::Failed);
    }
  }
}

/** Withdraws all parameters of the sensor, and adds a warning with the reason \a contradiction, a clause. */
void
WithdrawGain(Report & report, EstimateStatus status, const std::string & contradiction)
{
  SetSensorParameters(report, status);
  report.covariance.reset();
  report.Warn(WarningCode::Contradicted,
              contradiction + ", so no gain is given. Record one unprocessed burst of one scene, with more lit frames");
}

/** Withdraws a gain whose line the variance does not follow, or that Filed() does not identify. */
void
WithdrawContradictedGain(Report & report)
{
  const Quantity & gain = report.gain;
  const auto &     chi2 = report.fit.reducedChi2;
  if (gain.status != EstimateStatus::Identified)
  {
    return;
  }
  if (chi2 && !(*chi2 >= LeastReducedChi2))
  {
    WithdrawGain(report,
                 EstimateStatus::Failed,
                 "the variance scatters about its line only " + RoundedApart(*chi2, LeastReducedChi2) +
                   " times as much as by chance (reduced chi2, expected at least " + Rounded(LeastReducedChi2) + ")");
  }
  else if (const Quantity filed = Filed(gain, QuantityDomain::Positive); filed.status != EstimateStatus::Identified)
  {
    const bool holdsZero = !(gain.interval95->low.value_or(-1.0) > 0.0);
    WithdrawGain(report,
                 filed.status,
                 holdsZero ? "the interval of the gain contains 0"
                           : "the gain is " + Measured(*gain.value, gain.standardError.value_or(0.0)) +
                               " DN/e-, with an error above " + Percent(LargestRelativeError));
  }
}

/** Returns the signal of the brightest intensity bin: its mean level minus the offset \a quantity [DN]; infinite: there
 * are no bins, or the offset has no value. */
double
SignalAbove(const Report & report, const Quantity & quantity)
{
  const auto brightest = std::max_element(report.scatter.mean.begin(), report.scatter.mean.end());
  return brightest == report.scatter.mean.end() || !quantity.value ? std::numeric_limits<double>::infinity()
                                                                   : std::max(0.0, *brightest - *quantity.value);
}
} // namespace

void
FileStatuses(Report & report)
{
  WithdrawDarkLevel(report);
  WithdrawVibration(report);
  WithdrawContradictedGain(report);
  const bool hadOffset = report.offset.status == EstimateStatus::Identified;
  for (const QuantityEntry & entry : QuantityList())
  {
    // QuantityEntry::of returns a pointer to const, because it also reads constant reports. This report is not
    // constant.
    if (auto * const quantity = const_cast<Quantity *>(entry.of(report)))
    {
      const double signalDn = entry.domain == QuantityDomain::Offset ? SignalAbove(report, *quantity) : 0.0;
      *quantity = Filed(*quantity, entry.domain, signalDn);
    }
  }
  if (hadOffset && report.offset.status != EstimateStatus::Identified)
  {
    WithdrawReadNoise(report, report.offset.status);
  }
}

} // namespace sensornoise
