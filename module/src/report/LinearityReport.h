// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_LinearityReport_h
#define sensornoise_report_LinearityReport_h

#include "SensorNoiseExport.h"
#include "moments/ExposureFit.h"
#include "sensornoise/Report.h"

#include <optional>

namespace sensornoise
{

/** Files the linearity of the response. The linearity error is an upper limit where its 95 % interval holds 0, and
 * `not-identifiable` where no exposures were given (null) or too few of their levels are in the range. */
SensorNoise_EXPORT void
ReportLinearity(Report & report, const std::optional<ExposureFit> & fit);

} // namespace sensornoise

#endif
