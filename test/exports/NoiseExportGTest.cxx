// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseExport.h"
#include "helpers/ExportTestHelper.h"

#include <limits>
#include <string>

using namespace sensornoise;

class NoiseExports : public ExportTest
{};

TEST_F(NoiseExports, AnotherFormatIsRefusedWithTheNamesOfAll)
{
  IsRefused("lightzone", { "\"lightzone\"", "dng, ndsafir" });
  EXPECT_THROW(ExportNoise("dng", {}), ExportError);
  const CameraNoise noise = ReadCameraNoise(m_Report);
  EXPECT_THROW(ExportNoise("dng", { noise, noise }), ExportError);
}

TEST_F(NoiseExports, AnotherRecordIsRefused)
{
  m_Report.texts["/schema"] = "itk-sensornoise-check/1";
  IsRefused("dng", { "itk-sensornoise-check/1", "expected \"itk-sensornoise-report/1\"" });
  m_Report.texts.erase("/schema");
  IsRefused("dng", { "no schema" });
}

TEST_F(NoiseExports, SettingsThatMakeNoSenseAreRefused)
{
  for (const double wrong : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    ExportSettings settings;
    settings.analogueGain = wrong;
    IsRefused("dng", { "analogue gain", "above 0" }, settings);
  }
  ExportSettings settings;
  settings.blackLevelDn = std::nan("");
  IsRefused("dng", { "black or white level", "finite" }, settings);
}
