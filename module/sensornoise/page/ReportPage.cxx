// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/page/ReportPage.h"


#include "sensornoise/page/FigureData.h"
#include "sensornoise/page/FigureStyle.h"
#include "sensornoise/page/Figures.h"
#include "sensornoise/page/HtmlText.h"
#include "sensornoise/page/PageSections.h"
#include "sensornoise/page/PageStyle.h"
#include "sensornoise/page/Verdict.h"


#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::string
Heading(const char * tag, const std::string & words)
{
  return "<" + std::string(tag) + ">" + Escaped(words) + "</" + tag + ">\n";
}

std::string
VerdictBox(const Verdict & verdict)
{
  const std::string word = verdict.severity == Severity::Note      ? "Measured."
                           : verdict.severity == Severity::Warning ? "Measured, with warnings."
                                                                   : "Not measured.";
  return "<p class=\"verdict is-" + std::string(NameOf(verdict.severity)) + "\"><span class=\"word\">" + word +
         "</span> " + Escaped(verdict.sentence) + "</p>\n";
}

/** A figure with its caption, or the sentence that stands in its place. */
std::string
FigureElement(const std::string & figure, const std::string & caption)
{
  return figure.rfind("<svg", 0) == 0
           ? "<figure>" + figure + "<figcaption>" + Escaped(caption) + "</figcaption></figure>\n"
           : figure;
}

std::string
CurveCaption(const FigureData & data)
{
  std::string text = "Temporal variance against mean, each point a bin of the pixels used: flicker and motion lift it, "
                     "and without them a line is left.";
  if (data.lineMean.empty())
  {
    text += " No line was fitted.";
  }
  else if (data.isIndicative)
  {
    text += " The dashed line is no measurement.";
  }
  return data.residuals.empty() ? text
                                : text + " Below, what is left of the points without the line, in units of the error "
                                         "that normal noise gives; shaded: two of them.";
}

std::string
NoiseSentence(const Report & report)
{
  if (!report.noiseCorrelation)
  {
    return "";
  }
  return "<p>The noise is taken for: <b>" + Escaped(report.noiseCorrelation->kind) + "</b>.</p>\n";
}

std::string
FiguresOf(const Report & report, const char * heading)
{
  const FigureData data = MakeFigureData(report);
  return Heading(heading, "Variance against mean") + FigureElement(CurveFigure(data), CurveCaption(data)) +
         Heading(heading, "Light and motion") +
         FigureElement(SeriesFigure(data), "What every frame's light differs by from the mean, and its shift.") +
         Heading(heading, "Correlation of the noise") + NoiseSentence(report) +
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
WarningsSection(const std::vector<Warning> & warnings, const char * heading)
{
  return warnings.empty() ? "" : Heading(heading, "Warnings, and what would help") + WarningList(warnings);
}

std::string
Page(const std::string & title, const std::string & body)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         Escaped(title) + "</title>\n<style>" + PageStyle + FigureStyle + "</style>\n</head>\n<body>\n" +
         Heading("h1", title) + body + "</body>\n</html>\n";
}

std::string
ChannelSection(const Report & report)
{
  return Heading("h2", "Channel " + report.channel) + VerdictBox(VerdictOf(report)) +
         "<details><summary>Everything of channel " + Escaped(report.channel) + "</summary>\n" + StackSentence(report) +
         QuantityTable(report) + FiguresOf(report, "h3") + Heading("h3", "EMVA 1288") + EmvaTable(report) +
         "</details>\n" + WarningsSection(report.warnings, "h3");
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
      text += "<td>" + Escaped(ValueText(*quantity)) + "</td>";
    }
    text += "</tr>\n";
  }
  text += "</tbody></table>\n";
  if (reports.joint)
  {
    text += "<p>Offset of all channels together: " + Escaped(ValueText(reports.joint->offset)) + " DN.</p>\n";
  }
  return text;
}
} // namespace

std::string
ToHtml(const Report & report, const PageMaps & maps)
{
  return Page("Noise of an image sensor",
              VerdictBox(VerdictOf(report)) + StackSentence(report) + QuantityTable(report) +
                WarningsSection(report.warnings, "h2") + FiguresOf(report, "h2") + MapsSection(maps) +
                Heading("h2", "EMVA 1288") + EmvaTable(report) + Heading("h2", "Settings") + SettingsTable(report));
}

std::string
ToHtml(const ChannelReports & reports, const PageMaps & maps)
{
  std::string body = VerdictBox(VerdictOf(reports)) + "<p class=\"soft\">Bayer mosaic " +
                     std::string(NameOf(reports.pattern)) + " (" + NameOf(reports.source) +
                     "); widths, heights and motion of a channel are in its own pixels.</p>\n" + ChannelTable(reports) +
                     WarningsSection(reports.warnings, "h2");
  for (const Report & report : reports.channels)
  {
    body += ChannelSection(report);
  }
  return Page("Noise of a colour sensor",
              body + MapsSection(maps) + Heading("h2", "Settings") + SettingsTable(reports.channels.front()));
}

std::string
ToSvg(const Report & report)
{
  return CurveAsSvgFile(MakeFigureData(report), VerdictOf(report).sentence);
}

} // namespace sensornoise
