// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "base/Text.h"
#include "page/PageSections.h"
#include "page/Figures.h"
#include "report/JsonWriter.h"
#include "sensornoise/Version.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
/** A setting, and the deviation of its gain from the line. */
struct LineDeviation
{
  double                setting{ 0.0 };
  std::optional<double> deviation;
  bool                  leavesLine{ false };
};

/** Returns the rows of each setting. */
std::vector<std::vector<SweepRow>>
RowsBySetting(const SweepSummary & summary)
{
  std::vector<std::vector<SweepRow>> settings;
  for (const SettingNoise & setting : summary.settings)
  {
    settings.emplace_back();
    for (const SweepRow & row : summary.rows)
    {
      if (row.setting == setting.setting)
      {
        settings.back().push_back(row);
      }
    }
  }
  return settings;
}

std::vector<LineDeviation>
DeviationsOf(const SweepSummary & summary)
{
  std::vector<LineDeviation> deviations;
  for (std::size_t i = 0; i < summary.settings.size(); ++i)
  {
    deviations.push_back(
      { summary.settings[i].setting, summary.line.deviation[i], static_cast<bool>(summary.line.isBeside[i]) });
  }
  return deviations;
}
} // namespace

void
WriteJson(JsonWriter & json, const NumberWithError & number)
{
  json.Object([&] { json.Member("value", number.value).Member("standard_error", number.standardError); });
}

void
WriteJson(JsonWriter & json, const SweepRow & row)
{
  json.Object([&] {
    json.Member("channel", row.channel)
      .Member("gain", row.gain)
      .Member("offset", row.offsetDn)
      .Member("read_noise", row.readNoiseDn)
      .Member("read_noise_electrons", row.readNoiseElectrons)
      .Member("full_well_electrons", row.fullWellElectrons)
      .Member("dynamic_range_db", row.dynamicRangeDb);
  });
}

void
WriteJson(JsonWriter & json, const GainLine::Part & part)
{
  json.Object([&] {
    json.Member("scale", part.scale)
      .Member("lowest", part.lowest)
      .Member("highest", part.highest)
      .Member("settings", part.settings)
      .Member("reduced_chi2", part.reducedChi2);
  });
}

void
WriteJson(JsonWriter & json, const GainSwitch & found)
{
  json.Object([&] {
    json.Member("below", found.below)
      .Member("above", found.above)
      .Member("gain_step", found.gainStep)
      .Member("read_noise_step", found.readNoiseStep);
  });
}

void
WriteJson(JsonWriter & json, const CommonGain & common)
{
  json.Object([&] {
    json.Member("channel", common.channel)
      .Member("gain", common.gain)
      .Member("settings", common.settings)
      .Member("reduced_chi2", common.reducedChi2)
      .Member("is_same", common.isSame)
      .Member("setting", common.setting)
      .Member("deviation", common.deviation);
  });
}

namespace
{
void
WriteJson(JsonWriter & json, const LineDeviation & deviation)
{
  json.Object([&] {
    json.Member("setting", deviation.setting)
      .Member("deviation", deviation.deviation)
      .Member("leaves_line", deviation.leavesLine);
  });
}

/** Writes the noise model of all ISO speeds for a program. The model is the text of its file, which is JSON itself. */
void
WriteModel(JsonWriter & json, const char * name, const std::optional<NoiseExport> & model, const std::string & reason)
{
  json.ObjectMember(name, [&] {
    json.Member("model", model ? std::optional<std::string>(model->files.front().bytes) : std::nullopt);
    json.Member("note", model ? model->note : reason);
  });
}
} // namespace

std::string
ToJson(const SweepSummary & summary)
{
  const auto  camera = summary.camera.empty() ? std::nullopt : std::optional<std::string>(summary.camera);
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("camera", camera).Member("channels", RowsBySetting(summary));
    json.ObjectMember("gain_line",
                      [&] { json.Member("parts", summary.line.parts).Member("deviations", DeviationsOf(summary)); });
    json.Member("conversion_gain_switch", summary.conversionSwitch);
    json.Member("common_gain", summary.commonGains);
    WriteModel(json, "android", summary.android, summary.androidReason);
    WriteModel(json, "darktable", summary.darktable, summary.darktableReason);
    json.Member("findings", FindingsOf(summary));
  });
  return text + '\n';
}

namespace
{
constexpr double figureHeight = 320.0; // [unit of the figure]
constexpr double axisBelow = 46.0;     // height of the ticks and the name of the axis [unit of the figure]

const char *
NameOfAxis(SettingKind kind)
{
  return kind == SettingKind::Iso ? "ISO speed" : kind == SettingKind::Gain ? "gain setting" : "exposure [s]";
}

using NumberOfRow = std::optional<NumberWithError> SweepRow::*;

/** Figure of a number of the rows against the setting, whose axis is logarithmic. */
struct SweepFigure
{
  NumberOfRow  number{ nullptr };
  const char * name{ "" };            ///< with the unit
  bool         isLogarithmic{ true }; ///< axis of the number; false: linear
  bool         hasLines{ false };     ///< whether the lines of the gains are drawn
};

/** Points with bars of 95 % intervals. */
struct SweepPoints
{
  std::vector<double> x;    // decimal logarithm of the setting
  std::vector<double> y;    // the number, or its decimal logarithm
  std::vector<double> barX; // ends of the bars, with a gap behind each
  std::vector<double> barY;
  FiniteRange         range;
};

SweepPoints
PointsOf(const SweepSummary & summary, const SweepFigure & figure)
{
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  const auto       scaled = [&figure](double number) { return figure.isLogarithmic ? std::log10(number) : number; };
  SweepPoints      points;
  for (const SweepRow & row : summary.rows)
  {
    if (const auto & known = row.*figure.number)
    {
      const double x = std::log10(row.setting);
      const double half = 1.96 * known->standardError;
      const double least = known->value - half;
      const double low = scaled(figure.isLogarithmic ? std::max(least, 0.1 * known->value) : least);
      const double high = scaled(known->value + half);
      points.x.push_back(x);
      points.y.push_back(scaled(known->value));
      points.barX.insert(points.barX.end(), { x, x, gap });
      points.barY.insert(points.barY.end(), { low, high, gap });
      points.range.Add({ low, high });
    }
  }
  return points;
}

/** Draws the lines of the gains, on the mean over the channels. */
void
DrawGainLines(SvgPanel & panel, const SweepSummary & summary)
{
  for (const GainLine::Part & part : summary.line.parts)
  {
    const auto level = [&part](double setting) { return std::log10(part.scale.value * setting); };
    panel.Line(
      { std::log10(part.lowest), std::log10(part.highest) }, { level(part.lowest), level(part.highest) }, "after");
  }
}

/** Draws a dashed vertical line in the middle of the switch. */
void
DrawSwitch(SvgPanel & panel, const SweepSummary & summary, const PlotAxis & y)
{
  if (summary.conversionSwitch)
  {
    const double x = 0.5 * std::log10(summary.conversionSwitch->below * summary.conversionSwitch->above);
    panel.Line({ x, x }, { y.low, y.high }, "third dashed");
  }
}

std::string
DrawFigure(const SweepSummary & summary, const SweepFigure & figure)
{
  constexpr int     mostTicks = 6;
  const SweepPoints points = PointsOf(summary, figure);
  if (points.x.empty())
  {
    return "<p>" + Escaped(figure.name) + ": no setting has a value.</p>\n";
  }
  FiniteRange settings;
  settings.Add(points.x);
  const PlotAxis x = settings.LogarithmicAxis();
  const PlotAxis y = figure.isLogarithmic ? points.range.LogarithmicAxis() : points.range.Axis(mostTicks);
  const double   left = y.LabelWidth() + 12.0;
  std::string    svg = OpenSvg(figureHeight, std::string(figure.name) + " of every setting with its 95 % interval");
  {
    SvgPanel panel(svg,
                   { left, 26.0, FigureWidth - left - 12.0, figureHeight - 26.0 - axisBelow },
                   x,
                   y,
                   NameOfAxis(summary.kind),
                   Escaped(figure.name));
    DrawSwitch(panel, summary, y);
    if (figure.hasLines)
    {
      DrawGainLines(panel, summary);
    }
    panel.Line(points.barX, points.barY, "error");
    panel.Points(points.x, points.y, "before", PlotMarker::Square);
  }
  return FigureElement(svg + "</svg>\n",
                       std::string("Squares: one for each channel, with 95 % intervals") +
                         (figure.hasLines ? "; line: gain = constant × setting" : "") +
                         (summary.conversionSwitch ? "; dashed: the switch of the conversion gain" : "") + ".");
}

/** Returns all figures with their headings. The dynamic range is in decibels, which are logarithms. The offset may be 0
 * or negative. */
std::string
DrawFigures(const SweepSummary & summary)
{
  const auto drawn = [&summary](const SweepFigure & figure) { return DrawFigure(summary, figure); };
  return Heading("h2", "Gain") + drawn({ &SweepRow::gain, "gain [DN/e⁻]", true, true }) + Heading("h2", "Read noise") +
         drawn({ &SweepRow::readNoiseElectrons, "read noise [e⁻]" }) +
         drawn({ &SweepRow::readNoiseDn, "read noise [DN]" }) + Heading("h2", "Full well and dynamic range") +
         drawn({ &SweepRow::fullWellElectrons, "full well [e⁻]" }) +
         drawn({ &SweepRow::dynamicRangeDb, "dynamic range [dB]", false }) + Heading("h2", "Offset") +
         drawn({ &SweepRow::offsetDn, "offset [DN]", false });
}

std::string
RowOfCells(const SweepCellRow & cells, const char * tag)
{
  std::string row;
  for (const std::string & cell : cells)
  {
    row += "<" + std::string(tag) + ">" + Escaped(cell) + "</" + tag + ">";
  }
  return "<tr>" + row + "</tr>\n";
}

std::string
TableOf(const SweepSummary & summary)
{
  const SweepCells cells = SweepCellsOf(summary);
  std::string      rows;
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    rows += RowOfCells(cells[i], "td");
  }
  return "<div style=\"overflow-x:auto\"><table class=\"settings\" style=\"white-space:nowrap\"><thead>" +
         RowOfCells(cells.front(), "th") + "</thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string
UnmeasuredTable(const SweepSummary & summary)
{
  std::string rows;
  for (const UnmeasuredSetting & each : summary.unmeasured)
  {
    rows += "<tr><th scope=\"row\" class=\"label\">" +
            Escaped(each.setting ? SettingText(summary.kind, *each.setting) : each.name) + "</th><td>" +
            Escaped(WithSigns(each.reason)) + "</td></tr>\n";
  }
  return rows.empty() ? ""
                      : Heading("h2", "Settings that were not measured") + "<table class=\"settings\"><tbody>\n" +
                          rows + "</tbody></table>\n";
}
} // namespace

std::string
ToHtml(const SweepSummary & summary)
{
  std::string findings;
  for (const std::string & finding : FindingsOf(summary))
  {
    findings += "<p>" + Escaped(finding) + "</p>\n";
  }
  return Page("Noise of an image sensor over its settings",
              "<p>" + Escaped(SweepTitle(summary)) + ".</p>\n" + findings + DrawFigures(summary) +
                Heading("h2", "All settings") + TableOf(summary) + UnmeasuredTable(summary) +
                "<p class=\"soft\">ITKSensorNoise " + Escaped(GetModuleVersion()) + "</p>\n",
              "");
}

} // namespace sensornoise
