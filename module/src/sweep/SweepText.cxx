// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "base/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** Returns the name of the settings as a column of the table. */
const char *
NameOfColumn(SettingKind kind)
{
  return kind == SettingKind::Iso ? "ISO" : kind == SettingKind::Gain ? "gain" : "exposure [s]";
}

std::string
CellOf(const std::optional<NumberWithError> & number)
{
  return number ? WithSigns(Measured(number->value, number->standardError)) : "-";
}

/** Returns lines of text whose columns stand below each other. */
std::string
AlignedText(const SweepCells & cells)
{
  std::array<std::size_t, SweepColumns> widest{};
  for (const SweepCellRow & row : cells)
  {
    for (std::size_t i = 0; i < SweepColumns; ++i)
    {
      widest[i] = std::max(widest[i], CharactersIn(row[i]));
    }
  }
  std::string text;
  for (const SweepCellRow & row : cells)
  {
    std::string line;
    for (std::size_t i = 0; i < SweepColumns; ++i)
    {
      line += PaddedRight(row[i], widest[i] + 2);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string
PartSentence(const SweepSummary & summary, const GainLine::Part & part)
{
  return "The gain is (" + Measured(part.scale.value, part.scale.standardError) + ") DN/e- x " +
         (summary.kind == SettingKind::Iso ? "ISO" : "gain setting") + " from " + Text(part.lowest) + " to " +
         Text(part.highest) + " (" + std::to_string(part.settings) + " settings).";
}

std::string
SwitchSentence(const SweepSummary & summary)
{
  const GainSwitch & found = *summary.conversionSwitch;
  std::string        signs;
  if (found.readNoiseStep)
  {
    signs += "the read noise in electrons falls to " +
             Measured(found.readNoiseStep->value, found.readNoiseStep->standardError) + " of its value";
  }
  if (found.gainStep)
  {
    signs += (signs.empty() ? "" : ", and ") + std::string("gain over setting changes by the factor ") +
             Measured(found.gainStep->value, found.gainStep->standardError);
  }
  return "The conversion gain is switched between " + SettingText(summary.kind, found.below) + " and " +
         SettingText(summary.kind, found.above) + ": " + signs + ". The step is above " +
         Rounded(Significance.severalTests) + " standard errors.";
}

std::string
LineSentences(const SweepSummary & summary)
{
  std::size_t gains = 0;
  for (const SettingNoise & setting : summary.settings)
  {
    gains += setting.gain ? 1 : 0;
  }
  return gains < 2 ? "The line of the gains needs two settings with a gain; there are " + std::to_string(gains) + "."
                   : "The gains do not follow the settings: no line gain = constant x setting has more than half of "
                     "the " +
                       std::to_string(gains) + " settings on it. Check the settings of the bursts.";
}

/** Returns why a \a format was not written. Missing levels are given with the command \a make. */
std::string
ReasonText(const std::string & reason, const std::string & make, const std::string & format)
{
  const std::size_t command = reason.find(" Give the "); // command for export-noise-model, not for a sweep
  return reason.substr(0, command) + (command == std::string::npos
                                        ? ""
                                        : " " + make +
                                            " from the passport with the levels of the camera in DN: "
                                            "export-noise-model passport.json --format " +
                                            format + " --black BLACK --white WHITE");
}

/** Returns a sentence that says whether the gains of a channel are equal at all exposures, with their mean. */
std::string
CommonGainSentence(const CommonGain & common)
{
  const std::string channel = common.channel == "mono" ? "The gain" : "The gain of channel " + common.channel;
  const std::string mean = "(" + Measured(common.gain.value, common.gain.standardError) + ") DN/e-";
  const std::string setting = SettingText(SettingKind::Exposure, common.setting);
  const std::string deviation =
    "(" + Measured(100.0 * std::abs(common.deviation.value), 100.0 * common.deviation.standardError) + ") %" +
    (common.deviation.value > 0.0 ? " above" : " below");
  const std::string count = std::to_string(common.settings);
  if (common.isSame)
  {
    return channel + " is the same at all " + count + " exposures: " + mean + ", their weighted mean. At " + setting +
           " it is " + deviation + " the others.";
  }
  return "Warning: " + LowerCase(channel.substr(0, 1)) + channel.substr(1) + " is not the same at all exposures: at " +
         setting + " it is " + deviation + " the others. The weighted mean of all " + count + " is " + mean +
         ", with an error that holds their scatter. Record all bursts at one gain, without saturation, or leave this "
         "exposure out.";
}
} // namespace

SweepCells
SweepCellsOf(const SweepSummary & summary)
{
  SweepCells cells{ { NameOfColumn(summary.kind),
                      "channel",
                      "gain g [DN/e-]",
                      "offset mu [DN]",
                      "read noise [DN]",
                      "read noise [e-]",
                      "full well [e-]",
                      "dynamic range [dB]" } };
  for (const SweepRow & row : summary.rows)
  {
    cells.push_back({ Text(row.setting),
                      row.channel,
                      CellOf(row.gain),
                      CellOf(row.offsetDn),
                      CellOf(row.readNoiseDn),
                      CellOf(row.readNoiseElectrons),
                      CellOf(row.fullWellElectrons),
                      CellOf(row.dynamicRangeDb) });
  }
  for (std::string & cell : cells.front())
  {
    cell = WithSigns(cell);
  }
  return cells;
}

std::vector<std::string>
FindingsOf(const SweepSummary & summary)
{
  std::vector<std::string> findings;
  for (const GainLine::Part & part : summary.line.parts)
  {
    findings.push_back(PartSentence(summary, part));
  }
  for (const CommonGain & common : summary.commonGains)
  {
    findings.push_back(CommonGainSentence(common));
  }
  if (summary.kind == SettingKind::Exposure && summary.commonGains.empty())
  {
    findings.emplace_back("Whether the gain is the same at all exposures needs two settings with a gain.");
  }
  if (summary.kind != SettingKind::Exposure && summary.line.parts.empty())
  {
    findings.push_back(LineSentences(summary));
  }
  for (std::size_t i = 0; i < summary.settings.size(); ++i)
  {
    if (summary.line.isBeside[i])
    {
      const double deviation = *summary.line.deviation[i];
      findings.push_back(SettingText(summary.kind, summary.settings[i].setting) + " leaves the line: its gain is " +
                         Percent(std::abs(deviation)) + (deviation > 0.0 ? " above" : " below") +
                         " it. Extended settings do so, whose digital numbers are scaled in another way.");
    }
  }
  if (summary.conversionSwitch)
  {
    findings.push_back(SwitchSentence(summary));
  }
  if (summary.android)
  {
    findings.push_back("Android's noise model: " + summary.android->note);
  }
  else if (!summary.androidReason.empty())
  {
    findings.push_back("Android's noise model is not fitted: " +
                       ReasonText(summary.androidReason, "Fit it", "android"));
  }
  if (summary.darktable)
  {
    findings.push_back("darktable's presets are in the passport: export-noise-model passport.json --format darktable "
                       "--output FILE. " +
                       summary.darktable->note);
  }
  else if (!summary.darktableReason.empty() && summary.darktableReason != summary.androidReason)
  {
    findings.push_back("darktable's presets are not made: " +
                       ReasonText(summary.darktableReason, "Make them", "darktable"));
  }
  for (std::string & finding : findings)
  {
    finding = WithSigns(finding);
  }
  return findings;
}

std::string
SweepTitle(const SweepSummary & summary)
{
  std::vector<double> measured;
  for (const SettingNoise & setting : summary.settings)
  {
    measured.push_back(setting.setting);
  }
  const std::size_t all = measured.size() + summary.unmeasured.size();
  return (summary.camera.empty() ? "" : summary.camera + ": ") + std::to_string(measured.size()) + " of " +
         std::to_string(all) + (all == 1 ? " setting measured" : " settings measured");
}

std::string
MakeText(const SweepSummary & summary)
{
  std::string text = SweepTitle(summary) + '\n';
  if (!summary.rows.empty())
  {
    text += AlignedText(SweepCellsOf(summary));
  }
  for (const UnmeasuredSetting & each : summary.unmeasured)
  {
    text += "not measured: " +
            (each.setting ? SettingText(summary.kind, *each.setting) + " (" + each.name + ")" : each.name) + ": " +
            WithSigns(each.reason) + '\n';
  }
  for (const std::string & finding : FindingsOf(summary))
  {
    text += finding + '\n';
  }
  return text;
}

} // namespace sensornoise
