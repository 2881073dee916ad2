// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <array>
#include <cstddef>
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

/** Returns the message of the first error, which has the numbers. */
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

namespace
{
/** First words of the actions in WarningTable and in the messages of both methods. */
constexpr std::array<const char *, 24> Commands{ "Change ", "Check ", "Choose ",  "Close ",   "Correct ", "Cover ",
                                                 "Expose ", "Fit ",   "Give ",    "Include ", "Keep ",    "Leave ",
                                                 "Let ",    "Look ",  "Measure ", "Open ",    "Read ",    "Record ",
                                                 "Reduce ", "Set ",   "Switch ",  "Try ",     "Use ",     "Wait " };

bool
IsCommand(const std::string & sentence)
{
  return std::any_of(
    Commands.begin(), Commands.end(), [&](const char * command) { return sentence.rfind(command, 0) == 0; });
}

/** Returns the position of the last sentence that begins before \a end; 0 for the first sentence. */
std::size_t
BeginOfSentence(const std::string & text, std::size_t end)
{
  for (std::size_t at = end; at-- > 2;)
  {
    const bool isEnd = text[at - 1] == ' ' && (text[at - 2] == '.' || text[at - 2] == '?' || text[at - 2] == ';');
    if (isEnd && text[at] >= 'A' && text[at] <= 'Z')
    {
      return at;
    }
  }
  return 0;
}

/** Returns the position of a command behind the last colon, as in "the flicker is not known: give the offset". Returns
 * the length of the message if it has no command there. */
std::size_t
BeginOfClause(const std::string & message)
{
  const std::size_t colon = message.rfind(": ");
  if (colon == std::string::npos)
  {
    return message.size();
  }
  return IsCommand(SentenceText(message.substr(colon + 2))) ? colon + 2 : message.size();
}

/** Returns the position of the action at the end of a message, or the length of the message if it has no action. */
std::size_t
BeginOfAction(const std::string & message)
{
  std::size_t action = message.size();
  for (std::size_t end = message.size(); end > 0;)
  {
    const std::size_t begin = BeginOfSentence(message, end);
    if (!IsCommand(message.substr(begin)))
    {
      break;
    }
    action = end = begin;
  }
  return action < message.size() ? action : BeginOfClause(message);
}

/** Warnings with the same code, of several channels or partitions. */
using WarningGroup = std::vector<Warning>;

/** Returns the warnings grouped by code, errors first, then warnings and notes, else in the order of the report. */
std::vector<WarningGroup>
GroupByCode(const std::vector<Warning> & warnings)
{
  std::vector<WarningGroup> groups;
  for (const Warning & warning : warnings)
  {
    const auto same = std::find_if(
      groups.begin(), groups.end(), [&](const WarningGroup & group) { return group.front().code == warning.code; });
    if (same == groups.end())
    {
      groups.push_back({ warning });
    }
    else
    {
      same->push_back(warning);
    }
  }
  std::stable_sort(groups.begin(), groups.end(), [](const WarningGroup & a, const WarningGroup & b) {
    return KindOf(a.front().code).severity > KindOf(b.front().code).severity;
  });
  return groups;
}

/** Returns the name of a warning as words, for example "few frames". */
std::string
WordsOf(const WarningKind & kind)
{
  std::string words = kind.name;
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

std::string
Title(const WarningKind & kind)
{
  std::string title = WordsOf(kind);
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

/** Returns links to the boxes of the warnings of one severity. */
std::vector<std::string>
LinksTo(const std::vector<Warning> & warnings, Severity severity)
{
  std::vector<std::string> links;
  for (const WarningGroup & group : GroupByCode(warnings))
  {
    const WarningKind & kind = KindOf(group.front().code);
    if (kind.severity == severity)
    {
      links.push_back("<a href=\"#" + std::string(kind.name) + "\">" + WordsOf(kind) + "</a>");
    }
  }
  return links;
}

/** Returns the box of a verdict: \a word, a colon and the links. */
std::string
Box(Severity severity, const std::string & word, const std::vector<std::string> & links)
{
  std::string list;
  for (const std::string & link : links)
  {
    list += (list.empty() ? ": " : ", ") + link;
  }
  return "<p class=\"verdict is-" + std::string(NameOf(severity)) + "\"><span class=\"word\">" + word + "</span>" +
         list + ".</p>\n";
}

std::string
BoxOf(Severity severity, const std::vector<Warning> & warnings, const std::string & notMeasured)
{
  const std::vector<std::string> links = LinksTo(warnings, severity);
  switch (severity)
  {
    case Severity::Error:
      return Box(severity, notMeasured, links);
    case Severity::Warning:
      return Box(severity,
                 "Measured, with " + std::to_string(links.size()) + (links.size() == 1 ? " warning" : " warnings"),
                 links);
    case Severity::Note:
      break;
  }
  return Box(severity, links.empty() ? "Measured, without warnings" : "Measured; these effects are allowed for", links);
}

/** Returns the findings of a group and then its actions, each action once, with signs in UTF-8. */
std::string
Paragraphs(const WarningGroup & group)
{
  std::string findings;
  std::string actions;
  for (const Warning & warning : group)
  {
    const WarningParts parts = SplitWarning({ warning.code, WithSigns(warning.message) });
    findings += "<p>" + Unbroken(WithCode(parts.finding)) + "</p>";
    const std::string action = "<p><span class=\"word\">Do:</span> " + WithCode(parts.action) + "</p>";
    actions += parts.action.empty() || actions.find(action) != std::string::npos ? "" : action;
  }
  return findings + actions;
}
} // namespace

WarningParts
SplitWarning(const Warning & warning)
{
  const WarningKind & kind = KindOf(warning.code);
  const std::size_t   begin = BeginOfAction(warning.message);
  if (begin > 0 && begin < warning.message.size())
  {
    const std::string finding = warning.message.substr(0, begin - 1);
    return { SentenceText(finding.back() == ':' ? finding.substr(0, finding.size() - 1) : finding),
             SentenceText(warning.message.substr(begin)) };
  }
  const std::string sentence = kind.sentence;
  return { SentenceText(warning.message), SentenceText(sentence.substr(BeginOfAction(sentence))) };
}

std::string
WarningBoxes(const std::vector<Warning> & warnings)
{
  std::string items;
  for (const WarningGroup & group : GroupByCode(warnings))
  {
    const WarningKind & kind = KindOf(group.front().code);
    const std::string   severity = NameOf(kind.severity);
    const std::string   name = kind.name;
    items += "<li class=\"warning is-" + severity + "\" id=\"" + name + "\"><h3>" + Title(kind) +
             " <span class=\"word\">" + severity + "</span></h3>" + Paragraphs(group) + "<p class=\"soft\"><code>" +
             name + "</code></p></li>\n";
  }
  return items.empty() ? "" : "<ul class=\"warnings\">\n" + items + "</ul>\n";
}

std::string
VerdictBox(const Report & report)
{
  return BoxOf(VerdictOf(report).severity, report.warnings, "Not measured");
}

std::string
VerdictBox(const ChannelReports & reports)
{
  std::string without;
  for (const Report & report : reports.channels)
  {
    without += report.gain.value ? "" : (without.empty() ? "" : ", ") + report.channel;
  }
  return BoxOf(SeverityOf(reports), WarningsOf(reports), "Not measured in " + Escaped(without));
}

} // namespace sensornoise
