// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SettingNoise.h"

#include "base/Text.h"

#include <stdexcept>

namespace sensornoise
{

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

} // namespace sensornoise
