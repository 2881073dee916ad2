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

/** The message of a warning in its two parts, as sentences of plain text. */
struct WarningParts
{
  std::string finding; ///< what was found, and why it matters
  std::string action;  ///< what to do; "" of a note that needs nothing
};

/** Divides the message of a warning. The action is its last sentences that begin with a command. A message of a warning
 * or error without one gets the action of WarningTable. */
WarningParts
SplitWarning(const Warning & warning);

/** One box for each code, errors first: its name, what was found, and the action. The code is the address of the box:
 * "#few-frames". "" where there are no \a warnings. */
std::string
WarningBoxes(const std::vector<Warning> & warnings);

/** The verdict in one sentence, with links to the warnings that limit it. */
std::string
VerdictBox(const Report & report);
std::string
VerdictBox(const ChannelReports & reports);

} // namespace sensornoise

#endif
