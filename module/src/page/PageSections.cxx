// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "page/Emva1288.h"
#include "page/FigureStyle.h"
#include "page/HtmlText.h"
#include "page/PageStyle.h"
#include "page/QuantityTable.h"
#include "sensornoise/ReportText.h"
#include "report/ReportJson.h"
#include "report/ReportTable.h"
#include "report/Signs.h"
#include "sensornoise/Version.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sensornoise
{
namespace
{
const std::string Separator = " \u00B7 ";

std::string
TextOfSetting(const Report::SettingValue & value)
{
  if (const auto * const number = std::get_if<double>(&value))
  {
    return Text(*number);
  }
  if (const auto * const truth = std::get_if<bool>(&value))
  {
    return *truth ? "yes" : "no";
  }
  if (const auto * const numbers = std::get_if<std::vector<double>>(&value))
  {
    std::string text;
    for (const double number : *numbers)
    {
      text += (text.empty() ? "" : ", ") + Text(number);
    }
    return text;
  }
  return std::get<std::string>(value);
}

/** With indices: "mu_y.dark" is mu with y.dark below the line, of letters and points. */
std::string
WithIndices(const std::string & text)
{
  const auto  isOfIndex = [](char c) { return c == '.' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::string html;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t line = std::min(text.find('_', at), text.size());
    std::size_t       end = std::min(line + 1, text.size());
    while (end < text.size() && isOfIndex(text[end]))
    {
      ++end;
    }
    html += Escaped(text.substr(at, line - at));
    html += line < text.size() ? "<sub>" + Escaped(text.substr(line + 1, end - line - 1)) + "</sub>" : "";
    at = end;
  }
  return html;
}

std::string
InputRow(const char * role, const InputFiles & input)
{
  const std::string count =
    input.IsOfPixels() ? "pixels, " : std::to_string(input.files) + (input.files == 1 ? " file, " : " files, ");
  const std::string hash =
    input.sha256.empty() ? "not computed: built without OpenSSL" : "<code>" + Escaped(input.sha256) + "</code>";
  return "<tr><th scope=\"row\">" + std::string(role) + "<small>" + count + std::to_string(input.bytes) +
         " bytes</small></th><td>SHA-256: " + hash + "</td></tr>\n";
}
} // namespace

std::string
Heading(const char * tag, const std::string & words)
{
  return "<" + std::string(tag) + ">" + Escaped(words) + "</" + tag + ">\n";
}

std::string
Page(const std::string & title, const std::string & body, const std::string & style)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         Escaped(title) + "</title>\n<style>" + PageStyle + FigureStyle + "</style>\n</head>\n<body>\n<main class=\"" +
         style + "\">\n" + Heading("h1", title) + body + "</main>\n</body>\n</html>\n";
}

std::string
Details(const std::string & title, const std::string & summary, const std::string & body)
{
  return "<details><summary><h2>" + Escaped(title) + "</h2>" +
         (summary.empty() ? "" : " <span class=\"soft\">" + Unbroken(Escaped(summary)) + "</span>") + "</summary>\n" +
         body + "</details>\n";
}

std::string
FrameWords(const Report & report)
{
  const CameraSettings & camera = report.camera;
  std::string            text = camera.camera.empty() ? "" : camera.camera + Separator;
  text += std::isfinite(camera.isoSpeed) ? "ISO " + Text(camera.isoSpeed) + Separator : "";
  text += std::isfinite(camera.exposureSeconds) ? Text(camera.exposureSeconds) + " s" + Separator : "";
  text += std::to_string(report.frames) + " frames" + TextOfCounted(report) + " of " + std::to_string(report.width) +
          " \u00D7 " + std::to_string(report.height) + " pixels";
  return report.bitDepth ? text + Separator + std::to_string(*report.bitDepth) + " bits" : text;
}

std::string
PixelWords(const Report & report)
{
  if (report.pixels.total == 0)
  {
    return "";
  }
  const auto fraction = [&report](std::size_t count) {
    return Percent(static_cast<double>(count) / static_cast<double>(report.pixels.total));
  };
  const bool isClipped = report.pixels.clipped * 100 >= report.pixels.total;
  return Separator + fraction(report.pixels.used) + " of the pixels used" +
         (isClipped ? Separator + fraction(report.pixels.clipped) + " clipped" : "");
}

std::string
TitleLine(const std::string & words, const std::string & date)
{
  const std::string time =
    date.empty() ? "" : "<span class=\"date\">" + Separator + "file date <time>" + Escaped(date) + "</time></span>";
  return "<p class=\"soft\">" + Escaped(words) + time + Separator + "ITKSensorNoise " + Escaped(GetModuleVersion()) +
         "</p>\n";
}

std::string
EmvaTable(const Report & report)
{
  if (!HasValues(report))
  {
    return "<p>None of its quantities is known.</p>\n";
  }
  std::string rows;
  for (const Emva1288Row & row : Emva1288Rows(report))
  {
    rows += "<tr><th scope=\"row\">" + WithIndices(row.symbol) + "</th><td>" + Escaped(row.name) + "</td><td>" +
            Escaped(row.value) + "<small>" + WithIndices(row.source) + "</small></td></tr>\n";
  }
  return "<p class=\"soft\">Symbols of EMVA 1288; values with \u2248 are computed from gain, read noise, offset and "
         "the "
         "highest level by the standard's linear model, not measured by its procedure.</p>\n<table><thead><tr><th "
         "scope=\"col\">Symbol</th><th scope=\"col\">Name</th><th scope=\"col\">Value</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string
LinearityTable(const Report & report)
{
  std::string rows;
  for (const LinearityRecord::Level & level : report.linearity.levels)
  {
    rows += "<tr><td>" + Text(level.exposure) + "</td><td>" + std::to_string(level.frames) + "</td><td>" +
            Text(level.meanDn) + "</td><td>" +
            (level.deviationPercent ? Rounded(*level.deviationPercent) : std::string("outside of the range")) +
            "</td></tr>\n";
  }
  return rows.empty() ? ""
                      : "<table><thead><tr><th scope=\"col\">Exposure</th><th scope=\"col\">Frames</th><th "
                        "scope=\"col\">Level [DN]</th><th scope=\"col\">Deviation from the line "
                        "[%]</th></tr></thead><tbody>\n" +
                          rows + "</tbody></table>\n";
}

std::string
PartsTable(const Report & report)
{
  std::string rows;
  for (const GainByPartsRecord & partition : report.gainByParts)
  {
    for (const GainByPartsRecord::Part & part : partition.parts)
    {
      rows += "<tr><th scope=\"row\">" + Escaped(part.name) + "</th><td>" + Escaped(partition.pattern) + "</td><td>" +
              Escaped(WithSigns(Measured(part.gain, part.standardError))) + "</td><td>" + Percent(part.pixelFraction) +
              "</td></tr>\n";
    }
  }
  return rows.empty() ? ""
                      : "<table><thead><tr><th scope=\"col\">Part</th><th scope=\"col\">Partition</th><th "
                        "scope=\"col\">Gain [DN/e\u207B]</th><th scope=\"col\">Pixels</th></tr></thead><tbody>\n" +
                          rows + "</tbody></table>\n";
}

std::string
InputTable(const std::optional<InputRecord> & input)
{
  if (!input)
  {
    return "";
  }
  const bool hasPixels = input->frames.IsOfPixels() || (input->dark && input->dark->IsOfPixels());
  const bool hasFiles = !input->frames.IsOfPixels() || (input->dark && !input->dark->IsOfPixels());
  return "<table class=\"settings\"><tbody>\n" + InputRow("frames", input->frames) +
         (input->dark ? InputRow("dark frames", *input->dark) : "") + "</tbody></table>\n<p class=\"soft\">" +
         (hasFiles ? "The hash of files is that of <code>cat FILES | sha256sum</code>: all files in the order of the "
                     "frames, behind a header the files of its pixels. "
                   : "") +
         (hasPixels ? "The hash of pixels is that of all their bytes, least significant first, a frame after the "
                      "other, row by row."
                    : "") +
         "</p>\n";
}

std::string
SettingsTable(const Report & report)
{
  std::string rows;
  const auto  add = [&rows](const std::string & name, const std::string & value) {
    rows += "<tr><th scope=\"row\">" + Escaped(name) + "</th><td>" + Escaped(value) + "</td></tr>\n";
  };
  add("version", "ITKSensorNoise " + std::string(GetModuleVersion()));
  add("method", report.method);
  if (report.bitDepth)
  {
    add("bit depth", std::to_string(*report.bitDepth) + " bits (" + report.bitDepthSource + ")");
  }
  if (report.quantisationStepDn)
  {
    add("quantization step", Text(*report.quantisationStepDn) + " DN");
  }
  if (report.clipLowDn && report.clipHighDn)
  {
    add("clip levels",
        Text(*report.clipLowDn) + " and " + Text(*report.clipHighDn) + " DN (" + report.clipSource + ")");
  }
  for (const auto & [name, value] : report.settings)
  {
    add(name, TextOfSetting(value));
  }
  return "<table class=\"settings\"><tbody>\n" + rows + "</tbody></table>\n";
}

} // namespace sensornoise
