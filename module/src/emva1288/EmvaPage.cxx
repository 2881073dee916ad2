// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"
#include "emva1288/EmvaText.h"
#include "page/PageSections.h"
#include "page/Figures.h"
#include "sensornoise/Emva1288.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
const char * const Standard = ", EMVA Standard 1288, Release 4.0 Linear";

/** Returns the results that are asked for first, as cards. */
std::string
KeyNumbers(const EmvaReport & report)
{
  return "<dl class=\"keys\">\n" + KeyCard("System gain K", report.gain, "DN/e-") +
         KeyCard("Dark noise", report.darkNoiseElectrons, "e-") +
         KeyCard("Saturation capacity", report.saturationElectrons, "e-") +
         KeyCard("Maximum SNR", report.largestSnr, "1") + KeyCard("DSNU", report.dsnu, "e-") +
         KeyCard("PRNU", report.prnu, "%") + "</dl>\n";
}

std::string
Notes(const EmvaReport & report)
{
  std::string items;
  for (const EmvaNote & note : report.notes)
  {
    items += "<li class=\"warning is-note\"><p>" + Escaped(SentenceText(note.message)) +
             "</p><p class=\"soft\"><code>" + Escaped(note.code) + "</code></p></li>\n";
  }
  return items.empty() ? ""
                       : Heading("h2", "What the recording lacks") + "<ul class=\"warnings\">\n" + items + "</ul>\n";
}

/** Returns the photon transfer curve beside the notes. */
std::string
CurveAndNotes(const EmvaReport & report)
{
  return "<div class=\"two\">\n<section>\n" + Heading("h2", "Photon transfer") +
         FigureElement(TransferFigure(report) + "</svg>\n",
                       "Temporal variance without the dark variance against the signal. The slope of the line is the "
                       "system gain K. The dashed line is at saturation, the largest variance.") +
         "</section>\n<section>\n" + Notes(report) + "</section>\n</div>\n";
}

std::string
QuantityTable(const EmvaReport & report)
{
  std::string groups;
  std::string section;
  std::string rows;
  for (const EmvaQuantityEntry & entry : EmvaQuantityList())
  {
    if (section != entry.section)
    {
      groups += QuantityGroupRows(EmvaSectionTitle(section), rows);
      section = entry.section;
      rows.clear();
    }
    const std::string equation = entry.equation;
    const std::string place = equation.empty()          ? ""
                              : equation.front() == '(' ? "equation " + equation
                                                        : "section " + equation;
    const std::string symbol = WithIndices(entry.symbol);
    rows += QuantityRow(LabelText(entry.label),
                        symbol + (symbol.empty() || place.empty() ? "" : ", ") + place,
                        report.*entry.quantity,
                        UnitOf(entry, report));
  }
  return TableOfGroups(groups + QuantityGroupRows(EmvaSectionTitle(section), rows));
}

/** Returns a table in HTML of rows of cells; the first row is its head. All cells are plain text. */
std::string
TableOf(const std::vector<std::vector<std::string>> & rows)
{
  std::string body;
  for (const std::vector<std::string> & row : rows)
  {
    const char * const tag = body.empty() ? "th" : "td";
    std::string        cells;
    for (const std::string & cell : row)
    {
      cells += std::string("<") + tag + ">" + Escaped(cell) + "</" + tag + ">";
    }
    body += body.empty() ? "<thead><tr>" + cells + "</tr></thead><tbody>\n" : "<tr>" + cells + "</tr>\n";
  }
  return "<div style=\"overflow-x:auto\"><table>" + body + "</tbody></table></div>\n";
}

std::string
NumberText(const std::optional<double> & number)
{
  return number ? Rounded(*number) : "\u2013";
}

/** Returns the photon transfer curve as a table. */
std::string
PointTable(const EmvaReport & report)
{
  const std::string &                   unit = report.settings.exposureUnit;
  std::vector<std::vector<std::string>> rows{ { unit.empty() ? "Exposure" : "Exposure [" + unit + "]",
                                                "Photons",
                                                "Frames",
                                                "Signal [DN]",
                                                "Variance [DN\u00B2]",
                                                "SNR",
                                                "Deviation [%]",
                                                "In the fit of K" } };
  for (const EmvaPoint & point : report.points)
  {
    rows.push_back({ NumberText(point.exposure),
                     NumberText(point.photons),
                     std::to_string(point.frames),
                     NumberText(point.signalDn),
                     NumberText(point.varianceDn2),
                     NumberText(point.snr),
                     NumberText(point.deviationPercent),
                     point.isInGainFit ? "yes" : "no" });
  }
  return TableOf(rows);
}

std::string
SettingsTable(const EmvaReport & report)
{
  const EmvaSettings & settings = report.settings;
  return TableOf({ { "Setting", "Value" },
                   { "quantization step", Text(settings.quantizationStepDn) + " DN" },
                   { "bit depth", settings.bitDepth == 0 ? "not known" : std::to_string(settings.bitDepth) },
                   { "unit of the exposure", settings.exposureUnit.empty() ? "not known" : settings.exposureUnit } });
}

std::string
Figures(const EmvaReport & report)
{
  return "<div class=\"maps\">\n<div>" + Heading("h2", "Signal-to-noise ratio") +
         FigureElement(SnrFigure(report) + "</svg>\n",
                       "Discs: signal over temporal noise. The lines follow from gain, dark noise and non-uniformity "
                       "by the linear model of the standard.") +
         "</div>\n<div>" + Heading("h2", "Linearity") +
         FigureElement(LinearityFigure(report) + "</svg>\n",
                       "The line is fitted from 5 to 95 % of saturation, with the relative deviations as weights. "
                       "Below: deviations from it.") +
         "</div>\n</div>\n";
}

/** Returns all below the title line. */
std::string
Body(const EmvaReport & report)
{
  return KeyNumbers(report) + CurveAndNotes(report) + Heading("h2", "All quantities") + QuantityTable(report) +
         Figures(report) +
         Details("Exposures", std::to_string(report.points.size()) + " flat exposures", PointTable(report)) +
         Details("Settings", "method emva1288", SettingsTable(report));
}

/** Returns number, size and hash of the frames' files; "" without them. */
std::string
InputSection(const std::optional<InputRecord> & input)
{
  return input ? Details("Input", "hash of the frames", InputTable(input)) : "";
}

std::string
TitleText(const PageTitle & title)
{
  return "EMVA 1288" + (title.name.empty() ? "" : ": " + title.name);
}

/** Returns the main results with one row for each plane. */
std::string
PlaneTable(const EmvaMosaicReport & report)
{
  std::vector<std::vector<std::string>> rows{ { "Plane",
                                                "System gain K [DN/e\u207B]",
                                                "Dark noise [e\u207B]",
                                                "Saturation capacity [e\u207B]",
                                                "DSNU [e\u207B]",
                                                "PRNU [%]" } };
  for (std::size_t i = 0; i < BayerPlanes.size(); ++i)
  {
    const EmvaReport & plane = report.planes[i];
    rows.push_back({ NameOf(BayerPlanes[i]),
                     ValueText(plane.gain),
                     ValueText(plane.darkNoiseElectrons),
                     ValueText(plane.saturationElectrons),
                     ValueText(plane.dsnu),
                     ValueText(plane.prnu) });
  }
  return TableOf(rows);
}
} // namespace

std::string
ToHtml(const EmvaReport & report, const PageTitle & title, const std::optional<InputRecord> & input)
{
  return Page(TitleText(title),
              TitleLine(EmvaSeriesWords(report) + Standard, title.date) + Body(report) + InputSection(input),
              "report");
}

std::string
ToHtml(const EmvaMosaicReport & report, const PageTitle & title, const std::optional<InputRecord> & input)
{
  std::string body = TitleLine("Bayer mosaic " + std::string(NameOf(report.pattern)) +
                                 ", each plane: " + EmvaSeriesWords(report.planes.front()) + Standard,
                               title.date) +
                     PlaneTable(report);
  for (std::size_t i = 0; i < BayerPlanes.size(); ++i)
  {
    const Quantity & gain = report.planes[i].gain;
    body += Details(std::string("Plane ") + NameOf(BayerPlanes[i]),
                    gain.value ? "gain " + ValueText(gain) + " DN/e\u207B" : "no gain",
                    Body(report.planes[i]));
  }
  return Page(TitleText(title), body + InputSection(input), "report");
}

std::string
ToSvg(const EmvaReport & report)
{
  return AsSvgFile(TransferFigure(report) + "</svg>\n",
                   report.gain.value ? "system gain K = " + ValueText(report.gain) + " DN/e\u207B"
                                     : "no system gain is identifiable");
}

} // namespace sensornoise
