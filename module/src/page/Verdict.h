// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Verdict_h
#define sensornoise_page_Verdict_h

#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** Result of a measurement or of a comparison. */
struct Verdict
{
  Severity    severity; ///< the worst of its warnings; an error where nothing was found
  std::string sentence; ///< plain text
};

/** Returns the gain and the read noise of a report as a sentence, or the first error where there is no gain. */
Verdict
VerdictOf(const Report & report);

/** Returns the worst severity of the channels of a mosaic; an error where a channel has no gain. */
Severity
SeverityOf(const ChannelReports & reports);

} // namespace sensornoise

#endif
