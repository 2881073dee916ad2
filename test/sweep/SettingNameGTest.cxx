// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/Setting.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** A name and the setting in it; 0: none. */
struct Case
{
  std::string name;
  SettingKind kind;
  double      value;
};
} // namespace

TEST(SettingName, IsReadFromNames)
{
  const std::vector<Case> cases{ { "iso800", SettingKind::Iso, 800.0 },
                                 { "cam_ISO 100b", SettingKind::Iso, 100.0 },
                                 { "1600", SettingKind::Iso, 1600.0 },
                                 { "gain2.5", SettingKind::Gain, 2.5 },
                                 { "cam_gain20dB_5ms", SettingKind::Gain, 10.0 },
                                 { "exposure10ms", SettingKind::Exposure, 0.01 },
                                 { "cam_exp0.5s_dark", SettingKind::Exposure, 0.5 },
                                 { "250us", SettingKind::Exposure, 250e-6 },
                                 { "2 s", SettingKind::Exposure, 2.0 },
                                 { "iso0", SettingKind::Iso, 0.0 },
                                 { "10msec", SettingKind::Exposure, 0.0 },
                                 { "frames", SettingKind::Iso, 0.0 },
                                 { "", SettingKind::Iso, 0.0 } };
  for (const Case & each : cases)
  {
    const auto found = SettingInName(each.name);
    EXPECT_EQ(found.has_value(), each.value > 0.0) << each.name;
    if (found)
    {
      EXPECT_EQ(found->kind, each.kind) << each.name;
      EXPECT_NEAR(found->value, each.value, 1e-12 * each.value) << each.name;
    }
  }
}

TEST(SettingName, HasKindsWithNames)
{
  for (const SettingKind kind : { SettingKind::Iso, SettingKind::Gain, SettingKind::Exposure })
  {
    EXPECT_EQ(SettingKindOf(NameOf(kind)), kind);
  }
  EXPECT_THROW(SettingKindOf("shutter"), std::invalid_argument);
  EXPECT_EQ(SettingText(SettingKind::Iso, 800.0), "ISO 800");
  EXPECT_EQ(SettingText(SettingKind::Exposure, 0.01), "exposure 0.01 s");
}

} // namespace sensornoise
