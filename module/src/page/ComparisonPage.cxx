// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Comparison.h"

#include "page/PageSections.h"
#include "page/Figures.h"
#include "report/ReportParts.h"
#include "sensornoise/Version.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{
namespace
{
constexpr double      RowHeight = 26.0;
constexpr double      RowsLeft = 184.0;
constexpr double      RowsWidth = FigureWidth - RowsLeft - 12.0;
constexpr double      BelowRows = 46.0; ///< height of the ticks and the name of the axis [unit of the figure]
constexpr std::size_t LongestName = 19; ///< letters that fit beside the rows

/** Returns the number of letters (code points) of UTF-8 text. */
std::size_t
LettersOf(const std::string & text)
{
  return static_cast<std::size_t>(
    std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/** Returns \a count letters of UTF-8 text from letter \a first on. */
std::string
Letters(const std::string & text, std::size_t first, std::size_t count)
{
  std::string part;
  std::size_t letter = 0;
  for (const char c : text)
  {
    letter += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    part += letter > first && letter <= first + count ? std::string(1, c) : "";
  }
  return part;
}

/** Returns the beginning and the end of \a text, with an ellipsis between them: at most \a longest letters. Names of
 * files often differ only there. */
std::string
Shortened(const std::string & text, std::size_t longest)
{
  const std::size_t letters = LettersOf(text);
  if (letters <= longest)
  {
    return text;
  }
  const std::size_t ending = (longest - 1) / 2;
  return Letters(text, 0, longest - 1 - ending) + "\u2026" + Letters(text, letters - ending, ending);
}

/** Returns whether all rows are compared with row 0, because the reports are of one channel. */
bool
HasOneFirst(const ComparedQuantity & quantity)
{
  return std::all_of(
    quantity.changes.begin(), quantity.changes.end(), [](const Change & change) { return change.first == 0; });
}

/** Returns the name of a row for a figure: its number, its label, shortened to fit, and the channel of a mosaic. */
std::string
RowName(const Comparison & comparison, std::size_t row)
{
  const ComparedReport & compared = comparison.rows[row];
  const std::string      number = std::to_string(row + 1) + " ";
  const std::string      channel = compared.report.channel == "mono" ? "" : " " + compared.report.channel;
  const std::size_t      used = number.size() + LettersOf(channel);
  return number + Shortened(compared.label, std::max<std::size_t>(LongestName, used + 4) - used) + channel;
}

/** Returns the interval to draw: the 95 % interval, else the value ± 1.96 standard errors. */
std::optional<Interval>
DrawnInterval(const Quantity & quantity)
{
  if (quantity.interval95)
  {
    return quantity.interval95;
  }
  if (quantity.value && quantity.standardError)
  {
    return Interval{ *quantity.value - 1.96 * *quantity.standardError,
                     *quantity.value + 1.96 * *quantity.standardError };
  }
  return std::nullopt;
}

/** Returns whether a number is finite and at most ExtremeValue in magnitude. */
bool
IsDrawn(const std::optional<double> & number)
{
  return number && std::abs(*number) <= ExtremeValue;
}

FiniteRange
RangeOf(const Comparison & comparison, const ComparedQuantity & compared)
{
  FiniteRange range;
  for (const ComparedReport & row : comparison.rows)
  {
    const Quantity & quantity = compared.Of(row);
    if (!IsDrawn(quantity.value))
    {
      continue;
    }
    range.Add(*quantity.value);
    if (const auto interval = DrawnInterval(quantity))
    {
      range.Add(IsDrawn(interval->low) ? *interval->low : *quantity.value);
      range.Add(IsDrawn(interval->high) ? *interval->high : *quantity.value);
    }
  }
  return range;
}

/** Returns the words that replace the point of a quantity which cannot be drawn. */
std::string
WordsWithout(const Quantity & quantity)
{
  if (quantity.status == EstimateStatus::UpperLimit)
  {
    return ValueText(quantity) + " (upper limit)";
  }
  if (quantity.value)
  {
    return ValueText(quantity); // beyond ExtremeValue
  }
  const std::string range = RangeText(quantity);
  return std::string(quantity.status == EstimateStatus::NotIdentifiable ? "not identifiable"
                                                                        : NameOf(quantity.status)) +
         (range.empty() ? "" : ": " + range);
}

std::string
HorizontalBar(const SvgPanel & panel, double low, double high, double y)
{
  // the panel clips its content, and short numbers keep the file small
  const double left = std::clamp(panel.X(low), -RowsWidth, 2.0 * RowsWidth);
  const double right = std::clamp(panel.X(high), -RowsWidth, 2.0 * RowsWidth);
  std::string  path = "M" + SvgNumber(left) + " " + SvgNumber(y) + "H" + SvgNumber(right);
  for (const double end : { left, right })
  {
    path += "M" + SvgNumber(end) + " " + SvgNumber(y - 4.0) + "v8";
  }
  return "<path class=\"error\" d=\"" + path + "\"/>\n";
}

/** Draws the value and the interval of one row. Words replace a value that cannot be drawn. */
void
DrawRow(std::string & svg, SvgPanel & panel, const Quantity & quantity, double y, double height)
{
  if (!IsDrawn(quantity.value))
  {
    svg += "<text class=\"instead\" x=\"8\" y=\"" + SvgNumber(y + 5.0) + "\">" + Escaped(WordsWithout(quantity)) +
           "</text>\n";
    return;
  }
  const auto interval = DrawnInterval(quantity);
  if (interval && IsDrawn(interval->low) && IsDrawn(interval->high))
  {
    svg += HorizontalBar(panel, *interval->low, *interval->high, y);
  }
  panel.Points(
    { *quantity.value }, { height - y }, interval ? "after" : "before", interval ? PlotMarker::Disc : PlotMarker::Ring);
}

/** Draws the interval of the first report as a band, if all reports are compared with it. */
void
DrawFirst(SvgPanel & panel, const Comparison & comparison, const ComparedQuantity & compared, double height)
{
  const auto interval = DrawnInterval(compared.Of(comparison.rows.front()));
  if (HasOneFirst(compared) && interval && IsDrawn(compared.Of(comparison.rows.front()).value) &&
      IsDrawn(interval->low) && IsDrawn(interval->high))
  {
    panel.Band({ *interval->low, *interval->high }, { 0.0, 0.0 }, { height, height }, "third");
  }
}

double
HeightOf(const Comparison & comparison)
{
  return RowHeight * static_cast<double>(comparison.rows.size());
}

/** Appends the rows of one quantity to a figure, from \a top on [unit of the figure]. */
void
DrawRows(std::string & svg, const Comparison & comparison, const ComparedQuantity & compared, double top)
{
  const double height = HeightOf(comparison);
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    svg += "<text x=\"" + SvgNumber(RowsLeft - 8.0) + "\" y=\"" +
           SvgNumber(top + RowHeight * (static_cast<double>(row) + 0.5) + 5.0) + "\" text-anchor=\"end\">" +
           Escaped(RowName(comparison, row)) + "</text>\n";
  }
  PlotAxis rows;
  rows.low = 0.0;
  rows.high = height;
  const std::string unit = UnitText(compared.entry->unit);
  SvgPanel          panel(svg,
                          { RowsLeft, top, RowsWidth, height },
                 RangeOf(comparison, compared).Axis(4),
                 rows,
                 Escaped(LabelText(compared.entry->label)) + " [" + (unit.empty() ? "1" : unit) + "]",
                 "");
  DrawFirst(panel, comparison, compared, height);
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    DrawRow(svg, panel, compared.Of(comparison.rows[row]), RowHeight * (static_cast<double>(row) + 0.5), height);
  }
}

/** Returns whether any row has a value that can be drawn. */
bool
HasFigure(const Comparison & comparison, const ComparedQuantity & quantity)
{
  return std::any_of(comparison.rows.begin(), comparison.rows.end(), [&](const ComparedReport & row) {
    return IsDrawn(quantity.Of(row).value);
  });
}

/** Returns the figure of one quantity as an SVG element for a page with FigureStyle. Each report has a line with its
 * value and 95 % interval, or words without a value. The band is the interval of the first report, if all are compared
 * with it. */
std::string
ComparisonFigure(const Comparison & comparison, const ComparedQuantity & quantity)
{
  std::string svg = OpenSvg(8.0 + HeightOf(comparison) + BelowRows,
                            LabelText(quantity.entry->label) + " of every report with its 95 % interval");
  DrawRows(svg, comparison, quantity, 8.0);
  return svg + "</svg>\n";
}

/** Returns the figures of all quantities, one below the other, as one SVG file. */
std::string
ComparisonAsSvgFile(const Comparison & comparison, const std::string & title)
{
  std::string drawn;
  double      top = 12.0;
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    if (HasFigure(comparison, quantity))
    {
      DrawRows(drawn, comparison, quantity, top);
      top += HeightOf(comparison) + BelowRows + 14.0;
    }
  }
  if (!drawn.empty())
  {
    drawn += "<text x=\"12\" y=\"" + SvgNumber(top + 4.0) +
             "\">bars: 95 % intervals; band: the first report's; rings: no error</text>\n";
    top += 20.0;
  }
  else
  {
    drawn = "<text x=\"12\" y=\"34\">No report has a value.</text>";
    top = 60.0;
  }
  return AsSvgFile(OpenSvg(top, "every quantity of every report with its 95 % interval") + drawn + "</svg>\n", title);
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

/** Returns the names of the warnings and errors of a report, each once, without notes. */
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

/** Returns the cell of a value: the value, its status unless it is identified, its interval or bounds, and a remark if
 * it has no error. */
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
    const std::string verdict = Escaped(VerdictText(comparison, quantity, row));
    rows += "<tr><th scope=\"row\" class=\"label short\">" + Escaped(RowName(comparison, row)) + "</th><td>" +
            ValueCell(quantity.Of(comparison.rows[row])) + "</td><td>" + Escaped(DifferenceText(quantity, row)) +
            Small(FractionText(quantity, row)) + "<small>" + (isChange ? "<b>" + verdict + "</b>" : verdict) +
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
            ? FigureElement(ComparisonFigure(comparison, quantity),
                            std::string("Bars: 95 % intervals") +
                              (HasOneFirst(quantity) ? ", the band the 95 % interval of the first report" : "") +
                              "; rings have no error.")
            : "<p>No report has a value.</p>\n";
  text += ChangeTable(comparison, quantity);
  for (const CommonMean & common : quantity.means)
  {
    text += "<p>" + Escaped(MeanSentence(quantity, common)) + "</p>\n";
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
              body + Heading("h2", "How changes are tested") + "<p class=\"soft\">" + Escaped(RuleText(comparison)) +
                "</p>\n<p class=\"soft\">ITKSensorNoise " + Escaped(GetModuleVersion()) + "</p>\n",
              "");
}

std::string
ToSvg(const Comparison & comparison)
{
  return ComparisonAsSvgFile(comparison, VerdictOf(comparison).sentence);
}

} // namespace sensornoise
