// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/JsonWriter.h"
#include "sweep/SweepSummary.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** A setting and how its gain deviates from the line. */
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
    json.ObjectMember("android", [&] {
      // the file of the model is JSON itself, as a text
      json.Member("model",
                  summary.android ? std::optional<std::string>(summary.android->files.front().bytes) : std::nullopt);
      json.Member("note", summary.android ? summary.android->note : summary.androidReason);
    });
    json.Member("findings", FindingsOf(summary));
  });
  return text + '\n';
}

} // namespace sensornoise
