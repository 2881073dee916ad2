// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseSweep.h"
#include "helpers/ExportTestHelper.h"
#include "sweep/SweepSummary.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace
{
constexpr double anySetting = std::numeric_limits<double>::quiet_NaN();

class SensorNoiseSweep : public ExportTest
{
protected:
  /** Gives the report of a camera whose gain is 0.005 x ISO and whose read noise is 3 electrons. */
  void
  Add(itk::SensorNoiseSweep * sweep, double iso)
  {
    const double a = 0.005 * iso;
    this->SetQuantity("/variance_slope", a);
    this->SetQuantity("/total_intercept", 9.0 * a * a - a * offset);
    this->SetQuantity("/gain", a);
    this->SetQuantity("/read_noise", 3.0 * a);
    m_Report.numbers["/gain/standard_error"] = 0.003 * a;
    for (const auto & [pointer, number] : m_Report.numbers)
    {
      sweep->SetNumber(pointer, number);
    }
    for (const auto & [pointer, text] : m_Report.texts)
    {
      sweep->SetText(pointer, text);
    }
    sweep->AddReport("iso" + std::to_string(static_cast<int>(iso)), iso);
  }
  itk::SensorNoiseSweep::Pointer
  Camera()
  {
    auto sweep = itk::SensorNoiseSweep::New();
    for (const double iso : { 100.0, 200.0, 400.0 })
    {
      this->Add(sweep, iso);
    }
    return sweep;
  }
};
} // namespace

TEST_F(SensorNoiseSweep, SummarisesItsReports)
{
  const auto sweep = this->Camera();
  sweep->AddUnmeasured("iso800", 800.0, "the frames are saturated");
  sweep->Summarise();
  EXPECT_NE(sweep->GetSummaryAsText().find("3 of 4 settings measured"), std::string::npos) << sweep->GetSummaryAsText();
  EXPECT_NE(sweep->GetSummaryAsText().find("The gain is (0.0050"), std::string::npos) << sweep->GetSummaryAsText();
  EXPECT_NE(sweep->GetSummaryAsJson().find("\"gain_line\": {\"parts\": [{"), std::string::npos)
    << sweep->GetSummaryAsJson();
  EXPECT_NE(sweep->GetSummaryAsHtml().find("the frames are saturated"), std::string::npos);
  sweep->SetSettingKind("shutter");
  EXPECT_THROW(sweep->Summarise(), itk::ExceptionObject);
}

TEST_F(SensorNoiseSweep, PoolsTheGainsOfExposures)
{
  const auto sweep = itk::SensorNoiseSweep::New();
  this->Add(sweep, 100.0);
  m_Report.numbers["/gain/standard_error"] = 0.003 * 0.5;
  sweep->SetSettingKind("exposure");
  for (const auto & [pointer, number] : m_Report.numbers)
  {
    sweep->SetNumber(pointer, number);
  }
  for (const auto & [pointer, text] : m_Report.texts)
  {
    sweep->SetText(pointer, text);
  }
  sweep->AddReport("longer", 200.0);
  sweep->Summarise();
  EXPECT_NE(sweep->GetSummaryAsJson().find("\"is_same\": true"), std::string::npos) << sweep->GetSummaryAsJson();
}

TEST_F(SensorNoiseSweep, ExportsASettingAndAll)
{
  const auto sweep = this->Camera();
  sweep->Export("ndsafir", 200.0);
  EXPECT_EQ(NumberAfter(sweep->GetFileBytes(0), "\"gains\": ["), 1.0) << sweep->GetFileBytes(0);
  EXPECT_EQ(sweep->GetNote().find("interpolated"), std::string::npos);
  sweep->Export("ndsafir", 300.0);
  EXPECT_NEAR(NumberAfter(sweep->GetFileBytes(0), "\"gains\": ["), 1.5, 1e-9);
  EXPECT_NE(sweep->GetNote().find("interpolated between the measured settings 200 and 400"), std::string::npos);
  sweep->SetMaxAnalogueIso(150.0);
  sweep->Export("android", anySetting);
  EXPECT_NE(sweep->GetFileBytes(0).find("\"max_analog_iso\": 150"), std::string::npos);
  EXPECT_THROW(sweep->Export("ndsafir", anySetting), itk::ExceptionObject) << "one of three is needed";
  EXPECT_EQ(sweep->GetNumberOfFiles(), 0U) << "a failed export leaves no files";
  EXPECT_THROW(sweep->Export("ndsafir", 800.0), itk::ExceptionObject) << "nothing is extrapolated";
  sweep->SetBlackLevel(64.0);
  sweep->SetWhiteLevel(1064.0);
  sweep->Export("deepinv", 200.0);
  EXPECT_EQ(NumberAfter(sweep->GetFileBytes(0), "\"gain\": "), 0.001);
  std::ostringstream printed;
  sweep->Print(printed);
  EXPECT_NE(printed.str().find("Settings: 3"), std::string::npos);
}

TEST_F(SensorNoiseSweep, ReadsSettingsFromNames)
{
  EXPECT_EQ(itk::SensorNoiseSweep::GetSettingInNameAsJson("iso800"), "{\"kind\": \"iso\", \"value\": 800}");
  EXPECT_EQ(itk::SensorNoiseSweep::GetSettingInNameAsJson("10ms"), "{\"kind\": \"exposure\", \"value\": 0.01}");
  EXPECT_EQ(itk::SensorNoiseSweep::GetSettingInNameAsJson("frames"), "null");
}
