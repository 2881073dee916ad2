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
  Severity    severity; ///< Error: no result; Warning: a warning or a change; Note: neither
  std::string sentence; ///< the result, as plain text
};

/** Returns the gain and, if it is known, the read noise of a report as a sentence. Without a gain the sentence has the
 * message of the first error, and the severity is an error. */
Verdict
VerdictOf(const Report & report);

/** Returns the worst severity of the channels: an error if a channel has no gain. The warnings about all channels count
 * as warnings at most. */
Severity
SeverityOf(const ChannelReports & reports);

/** Message of a warning in two parts, as sentences of plain text. */
struct WarningParts
{
  std::string finding; ///< what was found, and why it matters
  std::string action;  ///< what to do; "" for a note that needs no action
};

/** Divides the message of a warning. The action is its last sentences that begin with a command, or a command behind
 * its last colon. Without one, a warning or error gets the action of WarningTable. */
WarningParts
SplitWarning(const Warning & warning);

/** Returns one HTML box for each code, errors first: its name, the findings, and the action. The code is the address of
 * the box, for example "#few-frames". "" if there are no \a warnings. */
std::string
WarningBoxes(const std::vector<Warning> & warnings);

/** Returns the verdict in one sentence as HTML, with links to the warnings of its severity. */
std::string
VerdictBox(const Report & report);
std::string
VerdictBox(const ChannelReports & reports);

} // namespace sensornoise

#endif
