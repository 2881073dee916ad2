// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/Setting.h"

#include "base/Text.h"

#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

namespace sensornoise
{
namespace
{
/** Returns the number that digits with a point are; NaN if it is too large for a double. */
double
NumberOfDigits(const std::string & digits)
{
  return FiniteNumber(digits).value_or(std::numeric_limits<double>::quiet_NaN());
}

/** Returns the seconds of a unit of time: "us", "ms" or "s". */
double
SecondsOf(const std::string & unit)
{
  return unit == "us" ? 1e-6 : unit == "ms" ? 1e-3 : 1.0;
}
} // namespace

const char *
NameOf(SettingKind kind)
{
  return kind == SettingKind::Iso ? "iso" : kind == SettingKind::Gain ? "gain" : "exposure";
}

SettingKind
SettingKindOf(const std::string & name)
{
  for (const SettingKind kind : { SettingKind::Iso, SettingKind::Gain, SettingKind::Exposure })
  {
    if (name == NameOf(kind))
    {
      return kind;
    }
  }
  throw std::invalid_argument("the settings are \"" + name + "\"; expected \"iso\", \"gain\" or \"exposure\"");
}

std::string
SettingText(SettingKind kind, double setting)
{
  return kind == SettingKind::Iso    ? "ISO " + Text(setting)
         : kind == SettingKind::Gain ? "gain " + Text(setting)
                                     : "exposure " + Text(setting) + " s";
}

double
GainOfDecibels(double decibels)
{
  return std::pow(10.0, decibels / 20.0);
}

std::optional<NamedSetting>
SettingInName(const std::string & name)
{
  static const std::regex iso("(?:^|.*[^a-z])iso[ _-]*([0-9]+(?:\\.[0-9]+)?)(?:[^0-9.].*)?");
  static const std::regex gain("(?:^|.*[^a-z])gain[ _]*([+-]?[0-9]+(?:\\.[0-9]+)?)[ _]*(db)?(?:[^0-9.].*)?");
  static const std::regex exposure(
    "(?:^|(?:.*[^a-z])?exp(?:osure)?[ _-]*)([0-9]+(?:\\.[0-9]+)?)[ _]*(us|ms|s)(?:[^a-z0-9.].*)?");
  static const std::regex number("[0-9]+(?:\\.[0-9]+)?");
  const std::string       text = LowerCase(name);
  std::smatch             found;
  NamedSetting            setting;
  if (std::regex_match(text, found, iso))
  {
    setting.value = NumberOfDigits(found[1].str());
  }
  else if (std::regex_match(text, found, gain))
  {
    setting.kind = SettingKind::Gain;
    const double value = NumberOfDigits(found[1].str());
    setting.value = found[2].matched ? GainOfDecibels(value) : value;
  }
  else if (std::regex_match(text, found, exposure))
  {
    setting.kind = SettingKind::Exposure;
    setting.value = NumberOfDigits(found[1].str()) * SecondsOf(found[2].str());
  }
  else if (std::regex_match(text, number))
  {
    setting.value = NumberOfDigits(text);
  }
  return std::isfinite(setting.value) && setting.value > 0.0 ? std::optional<NamedSetting>(setting) : std::nullopt;
}

} // namespace sensornoise
