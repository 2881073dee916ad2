// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportPage.h"

#include "base/Text.h"
#include "page/Figures.h"
#include "sensornoise/ReportText.h"
#include "page/PageSections.h"
#include "report/ReportParts.h"

#include <algorithm>
#include <optional>
#include <string>

namespace sensornoise
{
namespace
{
constexpr double LeastSpread = 1.05; ///< FigureData::residualSpread from which on the caption names it [1]

/** Returns a figure with its caption, if any, or the sentence that replaces a figure without data. */
std::string
FigureOrSentence(const std::string & figure, const std::string & caption)
{
  return figure.rfind("<svg", 0) == 0 ? FigureElement(figure, Escaped(caption)) : figure;
}

const char * const CurveWords =
  "Each point is an intensity bin of the pixels used. Flicker and motion add to the "
  "variance (orange rings). Without them the variance is a line (blue discs), whose slope "
  "is the gain if the noise is white.";

const char * const LevelSetWords =
  "Each point is a level set: areas of about one level, without edges and texture. Their variance is a line, whose "
  "slope is the gain if the noise is white.";

/** Returns a description of the points of the noise curve. */
std::string
PointWords(bool isOfLevelSets)
{
  return isOfLevelSets ? LevelSetWords : CurveWords;
}

/** Returns sentences on the residuals below the curve. \a spread: FigureData::residualSpread [1]. */
std::string
ResidualWords(double spread)
{
  const std::string text = " Below: deviations from the line, in standard errors of the point for normal noise; the "
                           "band is two of them.";
  return spread < LeastSpread ? text
                              : text + " The noise of neighbours is correlated, and the points may scatter up to " +
                                  Rounded(spread) + " times as far.";
}

std::string
CurveCaption(const FigureData & data)
{
  return PointWords(data.isOfLevelSets) + (data.lineMean.empty() ? " No line was fitted." : "") +
         (data.isIndicative ? " The dashed line is no measurement." : "") +
         (data.residuals.empty() ? "" : ResidualWords(data.residualSpread));
}

/** Returns an item of a list; "" for an empty sentence. */
std::string
Item(const std::string & sentence)
{
  return sentence.empty() ? "" : "<li>" + Escaped(SentenceText(sentence)) + "</li>\n";
}

/** Returns a list: quality of the fit, linearity of the response, and noise class. */
std::string
FitList(const Report & report)
{
  const std::string items = Item(DescribeFit(report)) + Item(DescribeResponse(report)) + Item(DescribeNoise(report));
  return items.empty() ? "" : "<ul class=\"checks\">\n" + items + "</ul>\n";
}

std::string
Section(const std::string & body)
{
  return body.empty() ? "" : "<section>\n" + body + "</section>\n";
}

std::string
WithHeading(const std::string & words, const std::string & body)
{
  return body.empty() ? "" : Heading("h2", words) + body;
}

/** Returns the noise curve beside the warnings and the quality of the fit. The warnings come first if there is no gain.
 */
std::string
CurveAndWarnings(const Report & report)
{
  const FigureData  data = MakeFigureData(report);
  const std::string curve =
    Section(Heading("h2", "Noise curve") + FigureOrSentence(CurveFigure(data), CurveCaption(data)));
  const std::string words = Section(WithHeading("What was found, and what to do", WarningBoxes(report.warnings)) +
                                    WithHeading("Quality of the fit", FitList(report)));
  return report.gain.value ? "<div class=\"two\">\n" + curve + words + "</div>\n"
                           : "<div class=\"two first-words\">\n" + words + curve + "</div>\n";
}

/** Returns the noise curves of all channels, side by side on a wide screen. */
std::string
CurvesOfChannels(const ChannelReports & reports)
{
  std::string figures;
  bool        hasResiduals = false;
  double      spread = 1.0;
  for (const Report & report : reports.channels)
  {
    const FigureData data = MakeFigureData(report);
    figures += "<div>" + Heading("h3", report.channel) + FigureOrSentence(CurveFigure(data), "") + "</div>\n";
    hasResiduals = hasResiduals || !data.residuals.empty();
    spread = std::max(spread, data.residualSpread);
  }
  return Heading("h2", "Noise curves") + "<div class=\"maps\">\n" + figures + "</div>\n<p class=\"soft\">" +
         PointWords(reports.channels.front().singleImage.has_value()) + (hasResiduals ? ResidualWords(spread) : "") +
         "</p>\n";
}

/** Returns the known values, for example "flicker 0.01 ± 0.001; motion x 0.1, y 0.2 pixel". */
std::string
MotionSummary(const Report & report)
{
  const auto value = [](const Quantity & quantity, const std::string & before, const std::string & after) {
    return quantity.value ? before + ValueText(quantity) + after : std::string();
  };
  const std::string motion =
    value(report.vibrationSdX, "; motion x ", "") + value(report.vibrationSdY, ", y ", " pixel");
  return value(report.flickerSd, "flicker ", "") + motion;
}

std::string
SeriesAndNoise(const Report & report)
{
  const FigureData data = MakeFigureData(report);
  return Details("Illumination and motion",
                 MotionSummary(report),
                 FigureOrSentence(SeriesFigure(data),
                                  "The illumination of each frame relative to the mean, and the shift of the scene.")) +
         Details("Correlation of the noise",
                 report.noiseCorrelation ? report.noiseCorrelation->kind : "",
                 FigureOrSentence(CorrelationFigure(data),
                                  "Correlation coefficient of the noise of pixels x columns and y rows apart, or of "
                                  "frames. If there are many lags, the figure has the lags that differ most from 0."));
}

std::string
MapsSection(const PageMaps & maps)
{
  return maps.IsEmpty() ? ""
                        : Details("Pixels",
                                  "mean image, and use of each pixel",
                                  "<div class=\"maps\">" + MeanPicture(maps) + PixelUsePicture(maps) + "</div>\n");
}

/** Returns the levels by exposure; "" if no exposures were given. */
std::string
LinearitySection(const Report & report)
{
  return report.linearity.levels.empty()
           ? ""
           : Details("Linearity",
                     std::to_string(report.linearity.levels.size()) + " exposures",
                     "<p>" + Escaped(SentenceText(DescribeLinearity(report))) + "</p>\n" + LinearityTable(report));
}

std::string
EmvaSection(const Report & report)
{
  return Details("EMVA 1288", "symbols of the standard", EmvaTable(report));
}

/** Returns the input files and all settings. */
std::string
SettingsSection(const std::optional<InputRecord> & input, const Report & report)
{
  return Details("Input and settings", "method " + report.method, InputTable(input) + SettingsTable(report));
}

std::string
ChannelSection(const Report & report)
{
  return Details("Channel " + report.channel,
                 report.gain.value ? "gain " + ValueText(report.gain) + " DN/e\u207B" : "not measured",
                 "<p class=\"soft\">" + Escaped(FrameWords(report) + PixelWords(report)) + "</p>\n" +
                   KeyNumbers(report) + QuantityTable(report) + WithHeading("Gain of the parts", PartsTable(report)) +
                   WithHeading("Quality of the fit", FitList(report)) + SeriesAndNoise(report) +
                   LinearitySection(report) + EmvaSection(report));
}

/** Returns "Noise of " with the name of the title, else the camera, else \a kind. */
std::string
TitleText(const PageTitle & title, const CameraSettings & camera, const std::string & kind)
{
  return "Noise of " + (!title.name.empty() ? title.name : !camera.camera.empty() ? camera.camera : kind);
}

/** Returns a table of gain, offset and read noise with one row for each channel, and the results of all channels
 * together. */
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
            Unbroken(Escaped(ValueText(reports.motion->sdY))) + " pixel of a channel.</p>\n";
  }
  return text;
}
} // namespace

std::string
ToHtml(const Report & report, const PageMaps & maps, const PageTitle & title)
{
  return Page(TitleText(title, report.camera, "an image sensor"),
              TitleLine(FrameWords(report) + PixelWords(report), title.date) + VerdictBox(report) + KeyNumbers(report) +
                CurveAndWarnings(report) + Heading("h2", "All quantities") + QuantityTable(report) +
                WithHeading("Gain of the parts", PartsTable(report)) + SeriesAndNoise(report) +
                LinearitySection(report) + MapsSection(maps) + EmvaSection(report) +
                SettingsSection(report.input, report),
              "report");
}

std::string
ToHtml(const ChannelReports & reports, const PageMaps & maps, const PageTitle & title)
{
  const Report & first = reports.channels.front();
  std::string body = TitleLine("Bayer mosaic " + std::string(NameOf(reports.pattern)) + " (" + NameOf(reports.source) +
                                 "), each channel: " + FrameWords(first),
                               title.date) +
                     VerdictBox(reports) + ChannelTable(reports) + CurvesOfChannels(reports) +
                     WithHeading("What was found, and what to do", WarningBoxes(WarningsOf(reports)));
  for (const Report & report : reports.channels)
  {
    body += ChannelSection(report);
  }
  return Page(TitleText(title, first.camera, "a colour sensor"),
              body + MapsSection(maps) + SettingsSection(reports.input, first),
              "report");
}

std::string
ToSvg(const Report & report)
{
  return CurveAsSvgFile(MakeFigureData(report), VerdictOf(report).sentence);
}

} // namespace sensornoise
