// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "page/Emva1288.h"
#include "page/FigureStyle.h"
#include "page/HtmlText.h"
#include "page/PageStyle.h"
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

/** Whether the page has a line for it: what has a value, and what every table has. */
bool
HasRow(const QuantityEntry & entry, const Report & report)
{
  const Quantity * const quantity = entry.of(report);
  return quantity != nullptr &&
         (entry.shown == ShownIn::EveryTable || (quantity->value && std::isfinite(*quantity->value)) ||
          (entry.shown == ShownIn::TableIfLimited && quantity->status == EstimateStatus::UpperLimit));
}

/** Escaped, and `names` as code. */
std::string
WithCode(const std::string & sentence)
{
  std::string text;
  bool        isCode = false;
  for (const char c : Escaped(sentence))
  {
    text += c == '`' ? std::string(isCode ? "</code>" : "<code>") : std::string(1, c);
    isCode = c == '`' ? !isCode : isCode;
  }
  return isCode ? text + "</code>" : text;
}

std::string
QuantityRow(const QuantityEntry & entry, const Quantity & quantity)
{
  const std::string  value = Escaped(ValueText(quantity));
  const std::string  unit = UnitText(entry.unit);
  const bool         hasNumber = (quantity.value && std::isfinite(*quantity.value)) || value.rfind("&lt;", 0) == 0;
  const bool         isPlain = quantity.status == EstimateStatus::Identified;
  const std::string  range = RangeText(quantity);
  const char * const kindOfRange = quantity.interval95 ? "95 %: " : "limits: ";
  return "<tr><th scope=\"row\">" + Escaped(LabelText(entry.label)) + "<small>" + WithCode(entry.meaning) +
         "</small></th><td><span class=\"nowrap\">" + value + "</span>" +
         (hasNumber && !unit.empty() ? " <span class=\"nowrap\">" + unit + "</span>" : "") +
         (isPlain ? "" : "<small>" + std::string(NameOf(quantity.status)) + "</small>") +
         (range.empty() ? "" : "<small>" + (kindOfRange + Escaped(range)) + "</small>") + "</td></tr>\n";
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

/** Whether any quantity has a value, or a limit. */
bool
HasValues(const Report & report)
{
  return std::any_of(QuantityList().begin(), QuantityList().end(), [&](const QuantityEntry & entry) {
    const Quantity * const quantity = entry.of(report);
    return quantity != nullptr && (quantity->value || quantity->status == EstimateStatus::UpperLimit);
  });
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
Page(const std::string & title, const std::string & body)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         Escaped(title) + "</title>\n<style>" + PageStyle + FigureStyle + "</style>\n</head>\n<body>\n" +
         Heading("h1", title) + body + "</body>\n</html>\n";
}

std::string
StackSentence(const Report & report)
{
  std::string text = std::to_string(report.frames) + " frames";
  text += TextOfCounted(report);
  text += " of " + std::to_string(report.width) + " \u00D7 " + std::to_string(report.height) + " pixels";
  text += report.bitDepth ? ", " + std::to_string(*report.bitDepth) + " bits (" + report.bitDepthSource + ")" : "";
  text += report.quantisationStepDn ? ", code step " + Text(*report.quantisationStepDn) + " DN" : "";
  if (report.clipLowDn && report.clipHighDn)
  {
    text +=
      ", levels " + Text(*report.clipLowDn) + " to " + Text(*report.clipHighDn) + " DN (" + report.clipSource + ")";
  }
  text += "; method " + report.method;
  if (report.pixels.total > 0)
  {
    text += "; " + Percent(static_cast<double>(report.pixels.used) / static_cast<double>(report.pixels.total)) +
            " of the pixels used";
    text += report.pixels.clipped * 100 >= report.pixels.total && report.pixels.total > 0
              ? ", " + Percent(static_cast<double>(report.pixels.clipped) / static_cast<double>(report.pixels.total)) +
                  " clipped"
              : "";
  }
  return "<p class=\"soft\">" + Escaped(text) + ".</p>\n";
}

std::string
QuantityTable(const Report & report)
{
  if (!HasValues(report))
  {
    return "<p>No quantity has a value.</p>\n";
  }
  std::string rows;
  for (const QuantityEntry & entry : QuantityList())
  {
    rows += HasRow(entry, report) ? QuantityRow(entry, *entry.of(report)) : "";
  }
  return "<table class=\"quantities\"><thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\">Value and standard "
         "error</th></tr></thead>"
         "<tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string
WarningList(const std::vector<Warning> & warnings)
{
  std::vector<Warning> sorted = warnings;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Warning & a, const Warning & b) {
    return KindOf(a.code).severity > KindOf(b.code).severity;
  });
  std::string items;
  for (const Warning & warning : sorted)
  {
    const WarningKind & kind = KindOf(warning.code);
    const std::string   severity = NameOf(kind.severity);
    items += "<li class=\"warning is-" + severity + "\"><p><span class=\"word\">" + severity + "</span> <span " +
             "class=\"soft\">" + kind.name + "</span></p><p>" + Escaped(SentenceText(warning.message)) +
             "</p><p class=\"soft\">" + WithCode(kind.sentence) + "</p></li>\n";
  }
  return items.empty() ? "" : "<ul class=\"warnings\">\n" + items + "</ul>\n";
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
  std::string rows = "<tr><th scope=\"row\">version</th><td>ITKSensorNoise " + Escaped(GetModuleVersion()) +
                     "</td></tr>\n<tr><th scope=\"row\">method</th><td>" + Escaped(report.method) + "</td></tr>\n";
  for (const auto & [name, value] : report.settings)
  {
    rows += "<tr><th scope=\"row\">" + Escaped(name) + "</th><td>" + Escaped(TextOfSetting(value)) + "</td></tr>\n";
  }
  return "<table class=\"settings\"><tbody>\n" + rows + "</tbody></table>\n";
}

} // namespace sensornoise
