// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Verdict.h"

#include "page/HtmlText.h"

#include <algorithm>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
Severity
WorstOf(const std::vector<Warning> & warnings)
{
  Severity worst = Severity::Note;
  for (const Warning & warning : warnings)
  {
    worst = std::max(worst, KindOf(warning.code).severity);
  }
  return worst;
}

/** The first error's own sentence, which has the numbers. */
std::string
WhyNot(const Report & report)
{
  const auto error = std::find_if(report.warnings.begin(), report.warnings.end(), [](const Warning & warning) {
    return KindOf(warning.code).severity == Severity::Error;
  });
  return error == report.warnings.end() ? "the warnings say why" : error->message;
}
} // namespace

Verdict
VerdictOf(const Report & report)
{
  if (!report.gain.value)
  {
    return { Severity::Error, SentenceText("No gain could be measured: " + WhyNot(report)) };
  }
  std::string sentence = "The gain is " + ValueText(report.gain) + " DN/e\u207B";
  if (report.readNoiseElectrons.value)
  {
    sentence += ", and the read noise " + ValueText(report.readNoiseElectrons) + " e\u207B";
  }
  return { std::min(WorstOf(report.warnings), Severity::Warning), sentence + "." };
}

Severity
SeverityOf(const ChannelReports & reports)
{
  Severity worst = std::min(WorstOf(reports.warnings), Severity::Warning);
  for (const Report & report : reports.channels)
  {
    worst = std::max(worst, VerdictOf(report).severity);
  }
  return worst;
}

} // namespace sensornoise
