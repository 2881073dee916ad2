// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/LinearityReport.h"

#include "base/ChiSquare.h"
#include "report/Quantities.h"

namespace sensornoise
{

void
ReportLinearity(Report & report, const std::optional<ExposureFit> & fit)
{
  if (!fit)
  {
    return;
  }
  constexpr double  percent = 100.0;
  LinearityRecord & linearity = report.linearity;
  linearity.reason = fit->reason;
  linearity.saturationDn = fit->saturationDn;
  linearity.saturationSource = fit->saturationSource;
  linearity.levels.clear();
  for (const ExposureFit::Level & level : fit->levels)
  {
    linearity.levels.push_back({ level.exposure, level.frames, level.meanDn, std::nullopt });
    if (level.deviation)
    {
      linearity.levels.back().deviationPercent = percent * *level.deviation;
    }
  }
  const double student = fit->dof > 0.0 ? StudentQuantile(0.975, fit->dof) : 0.0;
  if (fit->squaredError)
  {
    linearity.errorPercent = RootOf(
      percent * percent * fit->squaredError->value, percent * percent * fit->squaredError->standardError, student);
  }
  if (fit->offsetDn)
  {
    linearity.offsetSource = fit->isOffsetOfDarkFrames ? "dark frames" : "line";
    linearity.offsetDn = fit->isOffsetOfDarkFrames || student == 0.0
                           ? WithError(fit->offsetDn->value, fit->offsetDn->standardError)
                           : WithError(fit->offsetDn->value, fit->offsetDn->standardError, student);
  }
  if (fit->responsivity)
  {
    linearity.responsivity = WithError(fit->responsivity->value, fit->responsivity->standardError, student);
  }
}

} // namespace sensornoise
