// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "page/Figures.h"
#include "report/ReportParts.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Version.h"

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
/** Style of the page around the figures. On a wide screen a report has the curve beside the warnings. The curve is
 * 27rem wide, so that it ends above the bottom of a screen of 1280 x 800 pixels. On a telephone everything is one
 * column, and a row of the quantities becomes a line with its number and below it its meaning. */
inline constexpr const char * PageStyle = R"(
:root{--ink:#1b1f24;--soft:#57606a;--paper:#fff;--card:#f6f8fa;--edge:#d0d7de;--good:#00795a;--doubt:#945000;
--bad:#a83c00;color-scheme:light dark}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#a3adb8;--paper:#0d1117;--card:#161b22;--edge:#30363d;
--good:#2fc79a;--doubt:#e6a94a;--bad:#f58a4b}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif;overflow-wrap:break-word}
main{margin:0 auto;padding:1rem;max-width:48rem}
main.report{max-width:66rem}
h1{font-size:1.4rem;line-height:1.25;margin:0 0 .2rem;overflow-wrap:anywhere}
h2{font-size:1.15rem;line-height:1.3;margin:1.8rem 0 .4rem}
h3{font-size:1rem;margin:1.2rem 0 .3rem}
p{margin:.4rem 0}
h1+p{margin-top:0}
a{color:inherit}
a:focus-visible,summary:focus-visible{outline:.15rem solid var(--good);outline-offset:.15rem}
small,figcaption,.soft{color:var(--soft);font-size:.875rem}
.is-note{--mark:var(--good)}.is-warning{--mark:var(--doubt)}.is-error{--mark:var(--bad)}
.verdict,.warning,.key{background:var(--card);border-radius:.3rem;padding:.5rem .8rem}
.verdict,.warning,.key.is-warning{border-left:.35rem solid var(--mark)}
.verdict{margin:.6rem 0}
.warnings{list-style:none;padding:0;margin:0}
.warning{margin:0 0 .6rem}
.warning:target{outline:.15rem solid var(--mark)}
.warning h3{margin:0}
.warning p{margin:.2rem 0}
.word{font-weight:600;color:var(--mark)}
.keys{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:.75rem;margin:.6rem 0}
.key dt{color:var(--soft);font-size:.875rem}
.key dd{margin:0;font-variant-numeric:tabular-nums}
.key b{font-size:1.5rem;line-height:1.25;white-space:nowrap}
.two{display:grid;grid-template-columns:minmax(0,27rem) minmax(0,1fr);gap:0 1.75rem;align-items:start}
.two.first-words{grid-template-columns:minmax(0,1fr) minmax(0,27rem)}
.two h2{margin-top:.5rem}
.checks{padding-left:1.2rem;margin:.3rem 0}
table{width:100%;border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.35rem .5rem .35rem 0;border-bottom:1px solid var(--edge)}
thead th{color:var(--soft);font-weight:600;font-size:.875rem}
tbody th{font-weight:400}
tbody .group{font-weight:600;padding-top:1.1rem}
td small,th small{display:block}
.settings td,.label{overflow-wrap:anywhere}
.label{width:45%}.label.short{width:28%}
time,.nowrap,.number,.unit{white-space:nowrap}
.quantities .number{text-align:right}
.quantities .range{padding:.35rem 0 .35rem 1rem;width:14rem;color:var(--soft)}
.quantities .label{width:auto}
.quantities th small{max-width:32rem}
figure{margin:.4rem 0 1rem}
figure>svg{width:100%;max-width:640px;height:auto;display:block}
img{width:100%;max-width:512px;height:auto;image-rendering:pixelated;display:block;background:#000;
border:1px solid var(--edge)}
.maps h3{margin-top:.4rem}
.maps{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,18rem),1fr));gap:0 1rem}
.legend{list-style:none;padding:0;margin:.3rem 0;columns:2}
.legend li{padding-left:1.2rem;text-indent:-1.2rem;break-inside:avoid}
.legend i{display:inline-block;width:.8rem;height:.8rem;margin-right:.4rem;border:1px solid var(--soft)}
details{border-top:1px solid var(--edge);padding:.6rem 0}
table+details{margin-top:1.5rem}
details details{margin-left:1rem}
summary{cursor:pointer}
summary h2{display:inline;font-size:1rem;margin:0}
@media(max-width:52rem){.two,.two.first-words{grid-template-columns:minmax(0,1fr)}}
@media(max-width:36rem){body{font-size:15px}main{padding:.75rem}table{font-size:.875rem}
.keys{grid-template-columns:minmax(0,1fr);gap:.4rem}
.key{display:grid;grid-template-columns:6rem minmax(0,1fr)}
.key dt{grid-row:1/3;align-self:center}
.key dd{grid-column:2}
.key b{font-size:1.25rem}
.quantities tr{display:flex;flex-wrap:wrap;column-gap:.5rem;padding:.35rem 0;border-bottom:1px solid var(--edge)}
.quantities th,.quantities td,.quantities .range{border:0;padding:0}
.quantities tbody th:not(.group){display:contents}
.quantities .group{padding-top:1rem}
.quantities .label,.quantities th span{flex:1}
.quantities .range{order:1}
.quantities th small{order:2}
.quantities .range,.quantities th small{flex-basis:100%;width:auto}
.quantities .range{text-align:right}
details details{margin-left:0}}
@media print{main,main.report{max-width:none}details,figure,.warning,tr{break-inside:avoid}}
)";

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
  text += CountText(report.frames, "frame") + TextOfCounted(report) + " of " + std::to_string(report.width) +
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
         (hasFiles
            ? "The hash of files is the hash of <code>cat FILES | sha256sum</code>: all files in the order of the "
              "frames, behind a header the files of its pixels. "
            : "") +
         (hasPixels ? "The hash of pixels is the hash of all their bytes, least significant first, a frame after the "
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
        Text(*report.clipLowDn) + " and " + Text(*report.clipHighDn) + " DN (" + DescribeClipSource(report.clipSource) +
          ")");
  }
  for (const auto & [name, value] : report.settings)
  {
    add(name, TextOfSetting(value));
  }
  return "<table class=\"settings\"><tbody>\n" + rows + "</tbody></table>\n";
}

} // namespace sensornoise
