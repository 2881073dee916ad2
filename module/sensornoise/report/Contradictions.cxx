// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/Contradictions.h"

#include "sensornoise/base/Text.h"
#include "sensornoise/report/Quantities.h"

#include <string>

namespace sensornoise
{

namespace
{
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

void
WithdrawGain(Report & report, EstimateStatus status, const std::string & contradiction)
{
  SetSensorParameters(report, status);
  report.covariance.reset();
  report.Warn(WarningCode::Contradicted, contradiction + ": no gain is given");
}
} // namespace

void
WithdrawContradicted(Report & report)
{
  WithdrawVibration(report);
  if (report.gain.status != EstimateStatus::Identified)
  {
    return;
  }
  const auto & chi2 = report.fit.reducedChi2;
  const auto & interval = report.gain.interval95;
  if (chi2 && !(*chi2 >= LeastReducedChi2))
  {
    WithdrawGain(report,
                 EstimateStatus::Failed,
                 "the variance scatters about its line " + Rounded(*chi2) +
                   " times as chance makes it (reduced chi2, at least " + Rounded(LeastReducedChi2) + " expected)");
  }
  else if (interval && !(interval->low.value_or(-1.0) > 0.0))
  {
    WithdrawGain(report, EstimateStatus::NotIdentifiable, "the interval of the gain holds 0");
  }
}

} // namespace sensornoise
