// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RobustnessRun.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise::tools
{

Deviation
Compare(const Quantity & quantity, double truth, double unit)
{
  Deviation deviation;
  if (quantity.value)
  {
    deviation.error = (*quantity.value - truth) / unit;
    if (quantity.standardError)
    {
      deviation.z = (*quantity.value - truth) / *quantity.standardError;
    }
  }
  return deviation;
}

double
UsedFraction(const Report & report)
{
  return static_cast<double>(report.pixels.used) / static_cast<double>(std::max<std::size_t>(1, report.pixels.total));
}

Deviation
Summarise(const std::vector<const Run *> & runs, Deviation Run::* member)
{
  double errors = 0.0;
  double squares = 0.0;
  int    errorCount = 0;
  int    zCount = 0;
  for (const Run * run : runs)
  {
    const Deviation & deviation = run->*member;
    errors += deviation.error.value_or(0.0);
    squares += std::pow(deviation.z.value_or(0.0), 2);
    errorCount += deviation.error ? 1 : 0;
    zCount += deviation.z ? 1 : 0;
  }
  Deviation summary;
  summary.error = errorCount > 0 ? std::optional<double>(errors / errorCount) : std::nullopt;
  summary.z = zCount > 0 ? std::optional<double>(std::sqrt(squares / zCount)) : std::nullopt;
  return summary;
}

namespace
{
/** Whether the gain is as good as its case allows. */
bool
IsGainRight(const Run & run)
{
  if (run.stressCase.expectation == StressExpectation::Bent)
  {
    const auto & interval = run.report.gain.interval95;
    return interval && interval->low && interval->high && *interval->low <= run.gain && run.gain <= *interval->high;
  }
  return std::abs(*run.gainPercent.error) <= 1.0;
}
} // namespace

std::string
FindFault(const Run & run)
{
  if (run.stressCase.expectation == StressExpectation::Processed)
  {
    return "";
  }
  if (run.stressCase.expectation == StressExpectation::Refused)
  {
    const auto & warnings = run.report.warnings;
    const bool   isNamed = std::any_of(warnings.begin(), warnings.end(), [](const Warning & warning) {
      return warning.code == WarningCode::VarianceNotAffine;
    });
    return run.report.gain.status != EstimateStatus::Failed ? "not refused" : isNamed ? "" : "no variance-not-affine";
  }
  if (!run.gainPercent.error)
  {
    return "no gain";
  }
  if (!IsGainRight(run))
  {
    return "gain";
  }
  return run.intercept.z.has_value() && !(std::abs(*run.intercept.z) <= 3.0) ? "intercept" : "";
}

} // namespace sensornoise::tools
