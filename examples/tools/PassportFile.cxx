// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/PassportFile.h"

#include "sensornoise/Version.h"
#include "tools/ReportFile.h"
#include "tools/StoredReportFile.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
using Json = nlohmann::json;

template <typename T>
Json
JsonOrNull(const std::optional<T> & value)
{
  return value ? Json(*value) : Json();
}

/** Returns the text with U+FFFD in place of bytes that are not valid UTF-8. Names of files may have any bytes. */
std::string
AsUtf8(const std::string & text)
{
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
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

SettingKind
KindIn(const Json & record, const std::string & file)
{
  try
  {
    return SettingKindOf(MemberOf(record, "setting", Json::value_t::string, file).get<std::string>());
  }
  catch (const std::invalid_argument & error)
  {
    throw UnfitReport("the passport " + file + ": " + error.what());
  }
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

/** Returns the settings that leave the line of the gains, with their deviations. */
std::map<double, double>
OffLineIn(const Json & record)
{
  std::map<double, double> offLine;
  const Json               deviations = record.value(Json::json_pointer("/gain_line/deviations"), Json::array());
  for (const Json & each : deviations)
  {
    const auto setting = each.is_object() ? NumberIn(each, "setting") : std::nullopt;
    const auto deviation = each.is_object() ? NumberIn(each, "deviation") : std::nullopt;
    if (setting && deviation && each.value("leaves_line", Json()) == true)
    {
      offLine[*setting] = *deviation;
    }
  }
  return offLine;
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
  passport.kind = KindIn(record, file);
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
  passport.offLine = OffLineIn(record);
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
  range.kind = passport.kind;
  range.switchBetween = passport.switchBetween;
  range.offLine = passport.offLine;
  for (const UnmeasuredSetting & each : UnmeasuredOf(passport))
  {
    if (each.setting)
    {
      range.unmeasured[*each.setting] = each.reason;
    }
  }
  for (const PassportEntry * const entry : measured)
  {
    const std::string name = passport.name.empty() ? entry->name : passport.name + " (" + entry->name + ")";
    AddSetting(range, ReadCameraNoise(ValuesOfJson(name, entry->report), settings), *entry->setting);
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
  Json        found = Json::parse(sensornoise::ToJson(summary));
  std::size_t measured = 0;
  Json        settings = Json::array();
  for (const PassportEntry & entry : passport.entries)
  {
    const bool isMeasured = entry.reason.empty();
    settings.push_back({ { "name", AsUtf8(entry.name) },
                         { "setting", JsonOrNull(entry.setting) },
                         { "status", isMeasured ? "measured" : "failed" },
                         { "reason", isMeasured ? Json() : Json(AsUtf8(entry.reason)) },
                         { "options", AsUtf8(entry.options) },
                         { "channels", isMeasured ? found["channels"][measured] : Json::array() },
                         { "report", entry.report } });
    measured += isMeasured ? 1 : 0;
  }
  for (const char * const program : { "android", "darktable" })
  {
    Json & model = found[program]["model"];
    model = model.is_string() ? Json::parse(model.get<std::string>()) : Json();
  }
  const Json record{ { "schema", PassportSchema },
                     { "version", GetModuleVersion() },
                     { "setting", NameOf(passport.kind) },
                     { "camera", found["camera"] },
                     { "settings", settings },
                     { "gain_line", found["gain_line"] },
                     { "conversion_gain_switch", found["conversion_gain_switch"] },
                     { "common_gain", found["common_gain"] },
                     { "android", found["android"] },
                     { "darktable", found["darktable"] },
                     { "findings", found["findings"] } };
  return record.dump(1) + '\n';
}

} // namespace sensornoise::tools
