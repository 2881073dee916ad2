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

std::string
NumberOfWarnings(const std::vector<Warning> & warnings)
{
  const auto count = std::count_if(warnings.begin(), warnings.end(), [](const Warning & warning) {
    return KindOf(warning.code).severity == Severity::Warning;
  });
  return count == 1 ? "one warning says" : std::to_string(count) + " warnings say";
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
  const Severity worst = std::min(WorstOf(report.warnings), Severity::Warning);
  sentence += worst == Severity::Note ? "; every number below stands."
                                      : "; " + NumberOfWarnings(report.warnings) + " what is missing or does not fit.";
  return { worst, sentence };
}

Verdict
VerdictOf(const ChannelReports & reports)
{
  std::string without;
  Severity    worst = std::min(WorstOf(reports.warnings), Severity::Warning);
  for (const Report & report : reports.channels)
  {
    if (!report.gain.value)
    {
      without += (without.empty() ? "" : ", ") + report.channel;
    }
    worst = std::max(worst, VerdictOf(report).severity);
  }
  if (!without.empty())
  {
    return { Severity::Error, "No gain could be measured of the channels " + without + "." };
  }
  return { worst,
           worst == Severity::Note ? "All four channels of the mosaic have a gain; every number below stands."
                                   : "All four channels of the mosaic have a gain; the warnings say what is missing "
                                     "or does not fit." };
}

} // namespace sensornoise
