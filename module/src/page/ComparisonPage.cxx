// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/ComparisonPage.h"

#include "page/ComparisonFigure.h"
#include "page/ComparisonWords.h"
#include "page/HtmlText.h"
#include "page/PageSections.h"
#include "report/ReportJson.h"
#include "sensornoise/Version.h"

#include <cstddef>
#include <string>

namespace sensornoise
{
namespace
{
std::string
NameOfRow(const Comparison & comparison, std::size_t row)
{
  const ComparedReport & compared = comparison.rows[row];
  return std::to_string(row + 1) + " " + compared.label +
         (compared.report.channel == "mono" ? "" : " " + compared.report.channel);
}

std::string
Small(const std::string & words)
{
  return words.empty() ? "" : "<small>" + Escaped(words) + "</small>";
}

std::string
ComparisonBox(const Verdict & verdict)
{
  const std::string word = verdict.severity == Severity::Note      ? "No change."
                           : verdict.severity == Severity::Warning ? "Changed."
                                                                   : "Not compared.";
  return "<p class=\"verdict is-" + std::string(NameOf(verdict.severity)) + "\"><span class=\"word\">" + word +
         "</span> " + Escaped(verdict.sentence) + "</p>\n";
}

/** The names of warnings and errors, not of notes. */
std::string
WarningNames(const Report & report)
{
  std::string text;
  for (const Warning & warning : report.warnings)
  {
    const WarningKind & kind = KindOf(warning.code);
    const std::string   name = kind.name;
    if (kind.severity != Severity::Note && text.find(name) == std::string::npos)
    {
      text += (text.empty() ? "warnings: " : ", ") + name;
    }
  }
  return text;
}

std::string
HashText(const InputFiles & input)
{
  return std::string("SHA-256 of the frames' ") + (input.IsOfPixels() ? "pixels: " : "files: ") + input.sha256;
}

std::string
ReportTable(const Comparison & comparison)
{
  std::string rows;
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    const ComparedReport & compared = comparison.rows[row];
    const auto &           input = compared.report.input;
    rows += "<tr><th scope=\"row\" class=\"label\">" + Escaped(NameOfRow(comparison, row)) + "</th><td>" +
            Escaped(StackText(compared)) + Small(WarningNames(compared.report)) +
            Small(input && !input->frames.sha256.empty() ? HashText(input->frames) : "") + "</td></tr>\n";
  }
  return "<table class=\"settings\"><thead><tr><th scope=\"col\">Report</th><th scope=\"col\">Camera and "
         "frames</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

/** The value, what is known of it, or why there is none. */
std::string
ValueCell(const Quantity & quantity)
{
  const std::string range = RangeText(quantity);
  return Escaped(ValueText(quantity)) +
         Small(quantity.status == EstimateStatus::Identified ? "" : std::string(NameOf(quantity.status))) +
         Small(range.empty() ? "" : (quantity.interval95 ? "95 %: " : "limits: ") + range) +
         Small(quantity.value && !quantity.standardError ? "no error" : "");
}

std::string
ChangeTable(const Comparison & comparison, const ComparedQuantity & quantity)
{
  std::string rows;
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    const bool        isChange = quantity.changes[row].kind == ChangeKind::Changed;
    const std::string judgement = Escaped(JudgementText(comparison, quantity, row));
    rows += "<tr><th scope=\"row\" class=\"label short\">" + Escaped(RowName(comparison, row)) + "</th><td>" +
            ValueCell(quantity.Of(comparison.rows[row])) + "</td><td>" + Escaped(DifferenceText(quantity, row)) +
            Small(ShareText(quantity, row)) + "<small>" + (isChange ? "<b>" + judgement + "</b>" : judgement) +
            "</small></td></tr>\n";
  }
  const std::string unit = UnitText(quantity.entry->unit);
  return "<table class=\"settings\"><thead><tr><th scope=\"col\">Report</th><th scope=\"col\">Value" +
         (unit.empty() ? "" : " [" + unit + "]") +
         "</th><th scope=\"col\">Against the first</th></tr></thead><tbody>\n" + rows + "</tbody></table>\n";
}

std::string
QuantitySection(const Comparison & comparison, const ComparedQuantity & quantity)
{
  std::string text = Heading("h2", LabelText(quantity.entry->label)) + "<p class=\"soft\">" +
                     Escaped(quantity.entry->meaning) + "</p>\n";
  text += HasFigure(comparison, quantity)
            ? "<figure>" + ComparisonFigure(comparison, quantity) + "<figcaption>Bars: 95 % intervals" +
                (HasOneFirst(quantity) ? ", the band that of the first report" : "") +
                "; rings have no error.</figcaption></figure>\n"
            : "<p>No report has a value.</p>\n";
  text += ChangeTable(comparison, quantity);
  for (const CommonMean & common : quantity.means)
  {
    text += "<p>" + Escaped(MeanSentence(quantity, common)) + "</p>\n";
  }
  return text;
}

/** Lines of text are not broken by a browser. */
std::string
WithPlainBlanks(std::string text)
{
  const std::string blank = "\u00A0";
  for (std::size_t at = text.find(blank); at != std::string::npos; at = text.find(blank, at))
  {
    text.replace(at, blank.size(), " ");
  }
  return text;
}
} // namespace

std::string
ToHtml(const Comparison & comparison)
{
  std::string body = ComparisonBox(VerdictOf(comparison)) + ReportTable(comparison);
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    body += QuantitySection(comparison, quantity);
  }
  return Page("Noise of image sensors, compared",
              body + Heading("h2", "How changes are judged") + "<p class=\"soft\">" + Escaped(RuleText(comparison)) +
                "</p>\n<p class=\"soft\">ITKSensorNoise " + Escaped(GetModuleVersion()) + "</p>\n",
              "");
}

std::string
ToSvg(const Comparison & comparison)
{
  return ComparisonAsSvgFile(comparison, VerdictOf(comparison).sentence);
}

std::string
MakeText(const Comparison & comparison)
{
  std::string text;
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    text += NameOfRow(comparison, row) + ": " + StackText(comparison.rows[row]) + '\n';
  }
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    const std::string unit = UnitText(quantity.entry->unit);
    text += '\n' + LabelText(quantity.entry->label) + (unit.empty() ? "" : " [" + unit + "]") + '\n';
    for (std::size_t row = 0; row < comparison.rows.size(); ++row)
    {
      const std::string share = ShareText(quantity, row);
      const std::string difference = DifferenceText(quantity, row);
      text += "  " + NameOfRow(comparison, row) + ": " + ValueText(quantity.Of(comparison.rows[row])) +
              (difference.empty() ? "" : "; " + difference) + (share.empty() ? "" : ", " + share) + "; " +
              JudgementText(comparison, quantity, row) + '\n';
    }
    for (const CommonMean & common : quantity.means)
    {
      text += "  " + MeanSentence(quantity, common) + '\n';
    }
  }
  return WithPlainBlanks(text + '\n' + VerdictOf(comparison).sentence + '\n');
}

} // namespace sensornoise
