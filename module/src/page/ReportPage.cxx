// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportPage.h"

#include "base/Text.h"
#include "page/FigureData.h"
#include "page/Figures.h"
#include "page/HtmlText.h"
#include "page/MapPicture.h"
#include "page/PageSections.h"
#include "page/Verdict.h"
#include "sensornoise/ReportText.h"
#include "report/ReportTable.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr double LeastSpread = 1.05; ///< of residuals, to be worth a sentence

/** Numbers stay with the signs that belong to them: a line ends in front of a "+-", not behind it. */
std::string
Unbroken(std::string text)
{
  const std::string sign = "\u00B1 ";
  for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at + 1))
  {
    text.replace(at, sign.size(), "\u00B1&#160;");
  }
  return text;
}

std::string
VerdictBox(const Verdict & verdict)
{
  const std::string word = verdict.severity == Severity::Note      ? "Measured."
                           : verdict.severity == Severity::Warning ? "Measured, with warnings."
                                                                   : "Not measured.";
  return "<p class=\"verdict is-" + std::string(NameOf(verdict.severity)) + "\"><span class=\"word\">" + word +
         "</span> " + Unbroken(Escaped(verdict.sentence)) + "</p>\n";
}

/** A figure with its caption, if it has one, or the sentence that stands in its place. */
std::string
FigureElement(const std::string & figure, const std::string & caption)
{
  if (figure.rfind("<svg", 0) != 0)
  {
    return figure;
  }
  return "<figure>" + figure + (caption.empty() ? "" : "<figcaption>" + Escaped(caption) + "</figcaption>") +
         "</figure>\n";
}

const char * const CurveWords =
  "Temporal variance against mean, each point a bin of the pixels used: flicker and motion "
  "lift it, and without them a line is left.";

/** Of the residuals below the curve. \a spread: FigureData's. */
std::string
ResidualWords(double spread)
{
  const std::string text =
    " Below, what is left of the points without the line, in units of the error that normal noise "
    "of variance and mean gives; shaded: two of them.";
  return spread < LeastSpread ? text
                              : text + " Neighbours share their noise, for which the points may scatter up to " +
                                  Rounded(spread) + " times as far.";
}

std::string
CurveCaption(const FigureData & data)
{
  return CurveWords + std::string(data.lineMean.empty() ? " No line was fitted." : "") +
         (data.isIndicative ? " The dashed line is no measurement." : "") +
         (data.residuals.empty() ? "" : ResidualWords(data.residualSpread));
}

/** "" of none. */
std::string
Paragraph(const std::string & sentence)
{
  return sentence.empty() ? "" : "<p>" + Escaped(SentenceText(sentence)) + "</p>\n";
}

std::string
FitSentences(const Report & report)
{
  return Paragraph(DescribeFit(report)) + Paragraph(DescribeResponse(report));
}

std::string
CurveSection(const Report & report)
{
  const FigureData data = MakeFigureData(report);
  return Heading("h2", "Variance against mean") + FigureElement(CurveFigure(data), CurveCaption(data)) +
         FitSentences(report);
}

/** All channels' curves side by side, where there is room for that. */
std::string
CurvesOfChannels(const ChannelReports & reports)
{
  std::string figures;
  bool        hasResiduals = false;
  double      spread = 1.0;
  for (const Report & report : reports.channels)
  {
    const FigureData data = MakeFigureData(report);
    figures += "<div>" + Heading("h3", report.channel) + FigureElement(CurveFigure(data), "") + "</div>\n";
    hasResiduals = hasResiduals || !data.residuals.empty();
    spread = std::max(spread, data.residualSpread);
  }
  return Heading("h2", "Variance against mean") + "<div class=\"maps\">\n" + figures + "</div>\n<p class=\"soft\">" +
         CurveWords + (hasResiduals ? ResidualWords(spread) : "") + "</p>\n";
}

std::string
SeriesAndNoise(const Report & report, const char * heading)
{
  const FigureData data = MakeFigureData(report);
  return Heading(heading, "Light and motion") +
         FigureElement(SeriesFigure(data), "What every frame's light differs by from the mean, and its shift.") +
         Heading(heading, "Correlation of the noise") + Paragraph(DescribeNoise(report)) +
         FigureElement(CorrelationFigure(data),
                       "What pixels x columns and y rows apart, or frames, share of their noise; of many lags those "
                       "that differ most from 0.");
}

std::string
MapsSection(const PageMaps & maps)
{
  return maps.IsEmpty()
           ? ""
           : Heading("h2", "Pixels") + "<div class=\"maps\">" + MeanPicture(maps) + PixelUsePicture(maps) + "</div>\n";
}

std::string
WarningsSection(const std::vector<Warning> & warnings)
{
  return warnings.empty() ? "" : Heading("h2", "Warnings, and what would help") + WarningList(warnings);
}

std::string
InputSection(const std::optional<InputRecord> & input)
{
  return input ? Heading("h2", "Input") + InputTable(input) : "";
}

/** The levels by exposure, where exposures were given. */
std::string
LinearitySection(const Report & report, const char * heading)
{
  return report.linearity.levels.empty()
           ? ""
           : Heading(heading, "Linearity") + Paragraph(DescribeLinearity(report)) + LinearityTable(report);
}

std::string
PartsSection(const Report & report, const char * heading)
{
  return report.gainByParts.empty() ? "" : Heading(heading, "Gain of the parts") + PartsTable(report);
}

std::string
ChannelSection(const Report & report)
{
  return Heading("h2", "Channel " + report.channel) + VerdictBox(VerdictOf(report)) +
         "<details><summary>Everything of channel " + Escaped(report.channel) + "</summary>\n" + StackSentence(report) +
         QuantityTable(report) + PartsSection(report, "h3") + FitSentences(report) + SeriesAndNoise(report, "h3") +
         LinearitySection(report, "h3") + Heading("h3", "EMVA 1288") + EmvaTable(report) + "</details>\n";
}

/** Four columns, one a channel. */
std::string
ChannelTable(const ChannelReports & reports)
{
  std::string text = "<table><thead><tr><th scope=\"col\">Channel</th><th scope=\"col\">Gain [DN/e\u207B]</th><th "
                     "scope=\"col\">Offset [DN]</th><th scope=\"col\">Read noise [e\u207B]</th></tr></thead><tbody>\n";
  for (const Report & report : reports.channels)
  {
    text += "<tr><th scope=\"row\">" + Escaped(report.channel) + "</th>";
    for (const Quantity * const quantity : { &report.gain, &report.offset, &report.readNoiseElectrons })
    {
      text += "<td>" + Unbroken(Escaped(ValueText(*quantity))) + "</td>";
    }
    text += "</tr>\n";
  }
  text += "</tbody></table>\n";
  if (reports.joint)
  {
    text += "<p>Offset of all channels together: " + Unbroken(Escaped(ValueText(reports.joint->offset))) + " DN.</p>\n";
  }
  if (reports.motion)
  {
    text += "<p>Vibration of all channels together: x " + Unbroken(Escaped(ValueText(reports.motion->sdX))) + ", y " +
            Unbroken(Escaped(ValueText(reports.motion->sdY))) + " pixel of a plane.</p>\n";
  }
  return text;
}
} // namespace

std::string
ToHtml(const Report & report, const PageMaps & maps)
{
  const std::string table = QuantityTable(report);
  const std::string warnings = WarningsSection(report.warnings);
  return Page("Noise of an image sensor",
              VerdictBox(VerdictOf(report)) + StackSentence(report) +
                (report.gain.value ? table + warnings : warnings + Heading("h2", "Quantities") + table) +
                PartsSection(report, "h2") + CurveSection(report) + SeriesAndNoise(report, "h2") +
                LinearitySection(report, "h2") + MapsSection(maps) + Heading("h2", "EMVA 1288") + EmvaTable(report) +
                InputSection(report.input) + Heading("h2", "Settings") + SettingsTable(report));
}

std::string
ToHtml(const ChannelReports & reports, const PageMaps & maps)
{
  std::string body = VerdictBox(VerdictOf(reports)) + "<p class=\"soft\">Bayer mosaic " +
                     std::string(NameOf(reports.pattern)) + " (" + NameOf(reports.source) +
                     "); widths, heights and motion of a channel are in its own pixels.</p>\n" + ChannelTable(reports) +
                     WarningsSection(WarningsOf(reports)) + CurvesOfChannels(reports);
  for (const Report & report : reports.channels)
  {
    body += ChannelSection(report);
  }
  return Page("Noise of a colour sensor",
              body + MapsSection(maps) + InputSection(reports.input) + Heading("h2", "Settings") +
                SettingsTable(reports.channels.front()));
}

std::string
ToSvg(const Report & report)
{
  return CurveAsSvgFile(MakeFigureData(report), VerdictOf(report).sentence);
}

} // namespace sensornoise
