// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Verdict_h
#define sensornoise_page_Verdict_h

#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** What a measurement came to. */
struct Verdict
{
  Severity    severity; ///< the worst of its warnings; an error where there is no gain
  std::string sentence; ///< plain text
};

Verdict
VerdictOf(const Report & report);

/** Of all channels: names those without a gain. */
Verdict
VerdictOf(const ChannelReports & reports);

} // namespace sensornoise

#endif
