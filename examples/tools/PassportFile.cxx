// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/PassportFile.h"

#include "sensornoise/Version.h"
#include "tools/ReportFile.h"
#include "tools/StoredReportFile.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise::tools
{
namespace
{
using Json = nlohmann::json;

Json
JsonOf(const std::optional<NumberWithError> & number)
{
  return number ? Json{ { "value", number->value }, { "standard_error", number->standardError } } : Json();
}

template <typename T>
Json
JsonOrNull(const std::optional<T> & value)
{
  return value ? Json(*value) : Json();
}

/** Returns the text without what Unicode does not know, as the names of files may hold it. */
std::string
AsUtf8(const std::string & text)
{
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/** Returns the numbers of all channels at a setting. */
Json
ChannelsOf(const SweepSummary & summary, const std::optional<double> & setting)
{
  Json channels = Json::array();
  for (const SweepRow & row : summary.rows)
  {
    if (row.setting == setting)
    {
      channels.push_back({ { "channel", row.channel },
                           { "gain", JsonOf(row.gain) },
                           { "offset", JsonOf(row.offsetDn) },
                           { "read_noise", JsonOf(row.readNoiseDn) },
                           { "read_noise_electrons", JsonOf(row.readNoiseElectrons) },
                           { "full_well_electrons", JsonOf(row.fullWellElectrons) },
                           { "dynamic_range_db", JsonOf(row.dynamicRangeDb) } });
    }
  }
  return channels;
}

Json
LineOf(const SweepSummary & summary)
{
  Json parts = Json::array();
  for (const GainLine::Part & part : summary.line.parts)
  {
    parts.push_back({ { "scale", JsonOf(part.scale) },
                      { "lowest", part.lowest },
                      { "highest", part.highest },
                      { "settings", part.settings },
                      { "reduced_chi2", part.reducedChi2 } });
  }
  Json deviations = Json::array();
  for (std::size_t i = 0; i < summary.settings.size(); ++i)
  {
    deviations.push_back({ { "setting", summary.settings[i].setting },
                           { "deviation", JsonOrNull(summary.line.deviation[i]) },
                           { "leaves_line", static_cast<bool>(summary.line.isBeside[i]) } });
  }
  return { { "parts", parts }, { "deviations", deviations } };
}

Json
SwitchOf(const SweepSummary & summary)
{
  const auto & found = summary.conversionSwitch;
  return found ? Json{ { "below", found->below },
                       { "above", found->above },
                       { "gain_step", JsonOf(found->gainStep) },
                       { "read_noise_step", JsonOf(found->readNoiseStep) } }
               : Json();
}

Json
AndroidOf(const SweepSummary & summary)
{
  return { { "model", summary.android ? Json::parse(summary.android->files.front().bytes) : Json() },
           { "note", summary.android ? summary.android->note : summary.androidReason } };
}

const Json &
MemberOf(const Json & record, const char * name, Json::value_t type, const std::string & file)
{
  const auto found = record.is_object() ? record.find(name) : record.end();
  if (!record.is_object() || found == record.end() || found->type() != type)
  {
    throw UnfitReport("the passport " + file + " has no " + name +
                      " as estimate-sensor-noise --sweep writes it; expected a whole passport");
  }
  return *found;
}

PassportEntry
EntryOf(const Json & record, const std::string & file)
{
  PassportEntry entry;
  entry.name = MemberOf(record, "name", Json::value_t::string, file).get<std::string>();
  entry.options = MemberOf(record, "options", Json::value_t::string, file).get<std::string>();
  entry.setting = NumberIn(record, "setting");
  if (record.contains("reason") && record["reason"].is_string())
  {
    entry.reason = record["reason"].get<std::string>();
    return entry;
  }
  entry.report = MemberOf(record, "report", Json::value_t::object, file);
  if (!entry.setting || !(*entry.setting > 0.0))
  {
    throw UnfitReport("the passport " + file + " has a report without its setting (" + entry.name +
                      "); expected a number above 0");
  }
  return entry;
}
} // namespace

bool
IsPassport(const nlohmann::json & record)
{
  return record.is_object() && record.contains("schema") && record["schema"] == PassportSchema;
}

Passport
ReadPassport(const std::string & file)
{
  const Json record = ReadJsonFile(file);
  if (!IsPassport(record))
  {
    throw UnfitReport("the file " + file + " is no passport; expected the schema \"" + PassportSchema +
                      "\", as estimate-sensor-noise --sweep --json writes it");
  }
  Passport passport;
  passport.name = file;
  passport.isIso = MemberOf(record, "setting", Json::value_t::string, file) == "iso";
  for (const Json & entry : MemberOf(record, "settings", Json::value_t::array, file))
  {
    passport.entries.push_back(EntryOf(entry, file));
  }
  const auto found = record.find("conversion_gain_switch");
  if (found != record.end() && found->is_object())
  {
    const auto below = NumberIn(*found, "below");
    const auto above = NumberIn(*found, "above");
    if (!below || !above)
    {
      throw UnfitReport("the passport " + file +
                        " has a conversion_gain_switch without below and above; expected a "
                        "whole passport");
    }
    passport.switchBetween = { *below, *above };
  }
  return passport;
}

MeasuredRange
RangeOf(const Passport & passport, const ExportSettings & settings)
{
  std::vector<const PassportEntry *> measured;
  for (const PassportEntry & entry : passport.entries)
  {
    if (entry.reason.empty())
    {
      measured.push_back(&entry);
    }
  }
  std::stable_sort(measured.begin(), measured.end(), [](const PassportEntry * a, const PassportEntry * b) {
    return *a->setting < *b->setting;
  });
  MeasuredRange range;
  range.isIso = passport.isIso;
  range.switchBetween = passport.switchBetween;
  for (const PassportEntry * const entry : measured)
  {
    const std::string name = passport.name.empty() ? entry->name : passport.name + " (" + entry->name + ")";
    range.noise.push_back(ReadCameraNoise(ValuesOfJson(name, entry->report), settings));
    range.settings.push_back(*entry->setting);
    if (range.isIso)
    {
      range.noise.back().isoSpeed = entry->setting;
    }
  }
  return range;
}

std::vector<UnmeasuredSetting>
UnmeasuredOf(const Passport & passport)
{
  std::vector<UnmeasuredSetting> unmeasured;
  for (const PassportEntry & entry : passport.entries)
  {
    if (!entry.reason.empty())
    {
      unmeasured.push_back({ entry.name, entry.setting, entry.reason });
    }
  }
  return unmeasured;
}

std::string
ToJson(const Passport & passport, const SweepSummary & summary)
{
  Json settings = Json::array();
  for (const PassportEntry & entry : passport.entries)
  {
    const bool isMeasured = entry.reason.empty();
    settings.push_back({ { "name", AsUtf8(entry.name) },
                         { "setting", JsonOrNull(entry.setting) },
                         { "status", isMeasured ? "measured" : "failed" },
                         { "reason", isMeasured ? Json() : Json(AsUtf8(entry.reason)) },
                         { "options", AsUtf8(entry.options) },
                         { "channels", isMeasured ? ChannelsOf(summary, entry.setting) : Json::array() },
                         { "report", entry.report } });
  }
  const Json record{ { "schema", PassportSchema },
                     { "version", GetModuleVersion() },
                     { "setting", passport.isIso ? "iso" : "gain" },
                     { "camera", summary.camera.empty() ? Json() : Json(summary.camera) },
                     { "settings", settings },
                     { "gain_line", LineOf(summary) },
                     { "conversion_gain_switch", SwitchOf(summary) },
                     { "android", AndroidOf(summary) },
                     { "findings", FindingsOf(summary) } };
  return record.dump(1) + '\n';
}

} // namespace sensornoise::tools
