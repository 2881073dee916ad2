// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorTable.h"

#include "sensornoise/ReportText.h"
#include "studies/RealSensorFormat.h"
#include "studies/RealSensorStatistics.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Coverage and spread of one quantity. */
std::string
FormatCoverage(const JudgedStatistics & statistics)
{
  char text[64];
  std::snprintf(
    text, sizeof(text), "%7s %5s", FormatShare(statistics.held).c_str(), FormatNumber(statistics.rmsZ, "%.2f").c_str());
  return text;
}

std::string
FormatWarnings(const std::vector<RealSensorOutcome> & outcomes)
{
  std::string text;
  for (const auto & [code, count] : CountWarnings(outcomes))
  {
    text += (text.empty() ? "" : ", ") + code + ' ' + std::to_string(count);
  }
  return text.empty() ? "-" : text;
}

/** What the reports call the noise, with the number of stacks; empty: no report has a name for it. */
std::string
FormatKinds(const std::vector<RealSensorOutcome> & outcomes)
{
  std::map<std::string, std::size_t> counts;
  for (const RealSensorOutcome & outcome : outcomes)
  {
    ++counts[outcome.kind];
  }
  counts.erase("");
  std::string text;
  for (const auto & [kind, count] : counts)
  {
    text += (text.empty() ? "; noise " : ", ") + kind + ' ' + std::to_string(count);
  }
  return text;
}

std::string
FormatInterval(const std::optional<Interval> & interval)
{
  return interval ? '[' + FormatNumber(interval->low.value_or(-INFINITY), "%.5g") + ", " +
                      FormatNumber(interval->high.value_or(INFINITY), "%.5g") + ']'
                  : "-";
}

/** Value, standard error and z, or why there are none and the limits. */
std::string
FormatEstimate(JudgedQuantity quantity, const Judged & judged)
{
  const Quantity & estimate = judged.estimate;
  std::string      text = std::string(NameOf(quantity)) + ' ';
  if (judged.IsIdentified())
  {
    text += FormatNumber(*estimate.value, "%.5g") + " +- " +
            FormatNumber(estimate.standardError.value_or(NAN), "%.2g") + " (z " +
            FormatNumber(judged.Z().value_or(NAN), "%+.1f") + ')';
  }
  else
  {
    text += NameOf(estimate.status);
  }
  return text + (estimate.bracket ? ' ' + FormatInterval(estimate.bracket) : "") + " of " +
         FormatNumber(judged.truth, "%.5g");
}

} // namespace

void
PrintLineHeader(const RealSensorLine & line)
{
  std::printf("\n%s: %s\n", line.name.c_str(), line.what.c_str());
  std::printf("%-58s %-7s %4s %4s %4s | %7s %5s %6s %7s %7s %7s | %7s %5s | %7s %5s %5s | %7s %5s | %7s %7s | %s\n",
              "setting",
              "scene",
              "T",
              "n",
              "ref.",
              "g held",
              "rms z",
              "mean z",
              "s.e. %",
              "bias %",
              "p",
              "mu held",
              "rms z",
              "fl held",
              "rms z",
              "limit",
              "rn held",
              "rms z",
              "bracket",
              "mu in",
              "warnings");
}

void
PrintGroup(const RealSensorGroup & group)
{
  const auto gain = Judge(group.outcomes, JudgedQuantity::Gain);
  const auto offset = Judge(group.outcomes, JudgedQuantity::Offset);
  const auto flicker = Judge(group.outcomes, JudgedQuantity::Flicker);
  const auto readNoise = Judge(group.outcomes, JudgedQuantity::ReadNoise);
  std::printf("%-58s %-7s %4zu %4zu %4zu | %7s %5s %6s %7s %7s %7s | %s | %s %5s | %s | %7s %7s | %s\n",
              group.setting.name.c_str(),
              NameOf(group.setting.scene),
              group.setting.settings.frames,
              group.outcomes.size(),
              CountRefused(group.outcomes).met,
              FormatShare(gain.held).c_str(),
              FormatNumber(gain.rmsZ, "%.2f").c_str(),
              FormatNumber(gain.meanZ, "%+.2f").c_str(),
              FormatNumber(gain.errorPercent, "%.3g").c_str(),
              FormatNumber(gain.biasPercent, "%+.3g").c_str(),
              FormatNumber(gain.held.count == 0 ? NAN : BinomialLowerTail(gain.held, NominalCoverage), "%.2g").c_str(),
              FormatCoverage(offset).c_str(),
              FormatCoverage(flicker).c_str(),
              FormatShare(flicker.limitsHeld).c_str(),
              FormatCoverage(readNoise).c_str(),
              FormatShare(offset.bracketsHeld).c_str(),
              FormatShare(offset.inBracket).c_str(),
              (FormatWarnings(group.outcomes) + FormatKinds(group.outcomes)).c_str());
  std::fflush(stdout);
}

void
PrintStacks(const RealSensorGroup & group)
{
  for (const RealSensorOutcome & outcome : group.outcomes)
  {
    std::printf("  seed %llu:", static_cast<unsigned long long>(outcome.seed));
    for (std::size_t k = 0; k < NumberOfJudged; ++k)
    {
      const auto quantity = static_cast<JudgedQuantity>(k);
      std::printf(" %s;", FormatEstimate(quantity, outcome.Of(quantity)).c_str());
    }
    std::printf(" D %s; %s\n",
                FormatNumber(outcome.nonlinearity.value_or(NAN), "%.3g").c_str(),
                (FormatWarnings({ outcome }) + FormatKinds({ outcome })).c_str());
  }
}

} // namespace sensornoise::tools
