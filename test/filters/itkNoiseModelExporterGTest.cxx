// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkNoiseModelExporter.h"
#include "helpers/DngTestHelper.h"
#include "helpers/ExportTestHelper.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

class NoiseModelExporter : public ExportTest
{
protected:
  void
  Give(itk::NoiseModelExporter * exporter) const
  {
    for (const auto & [pointer, number] : m_Report.numbers)
    {
      exporter->SetNumber(pointer, number);
    }
    for (const auto & [pointer, text] : m_Report.texts)
    {
      exporter->SetText(pointer, text);
    }
    exporter->AddReport("report.json");
  }
};

TEST_F(NoiseModelExporter, MakesTheFilesOfTheLibrary)
{
  m_Report.numbers["/camera/iso_speed"] = 100.0;
  const auto exporter = itk::NoiseModelExporter::New();
  this->Give(exporter);
  for (const sensornoise::ExportFormat & format : sensornoise::ExportFormats())
  {
    if (format.leastReports > 1 || format.takes == sensornoise::ExportTakes::Maps)
    {
      continue;
    }
    const sensornoise::NoiseExport expected = this->Export(format.name);
    exporter->Export(format.name);
    ASSERT_EQ(exporter->GetNumberOfFiles(), expected.files.size());
    for (unsigned int i = 0; i < exporter->GetNumberOfFiles(); ++i)
    {
      EXPECT_EQ(exporter->GetFileName(i), expected.files[i].name);
      EXPECT_EQ(exporter->GetFileBytes(i), expected.files[i].bytes);
    }
    EXPECT_EQ(exporter->GetNote(), expected.note);
  }
  EXPECT_EQ(itk::NoiseModelExporter::GetFormatsAsJson(), sensornoise::ExportFormatsAsJson());
}

TEST_F(NoiseModelExporter, TakesSeveralReportsAndSettings)
{
  const auto exporter = itk::NoiseModelExporter::New();
  for (const double iso : { 100.0, 200.0 })
  {
    m_Report.numbers["/camera/iso_speed"] = iso;
    this->Give(exporter);
  }
  exporter->Export("android");
  EXPECT_NE(exporter->GetFileBytes(0).find("\"max_analog_iso\": null"), std::string::npos);
  exporter->SetMaxAnalogueIso(150.0);
  exporter->Export("android");
  EXPECT_NE(exporter->GetFileBytes(0).find("\"max_analog_iso\": 150"), std::string::npos);

  const auto one = itk::NoiseModelExporter::New();
  this->Give(one);
  one->SetBlackLevel(65.0);
  one->SetWhiteLevel(165.0);
  one->Export("deepinv");
  EXPECT_EQ(NumberAfter(one->GetFileBytes(0), "\"gain\": "), slope / 100.0);
  one->SetAnalogueGain(4.0);
  one->Export("libcamera");
  EXPECT_NE(one->GetNote().find("is taken as 4."), std::string::npos);
}

TEST_F(NoiseModelExporter, TakesMaps)
{
  const auto exporter = itk::NoiseModelExporter::New();
  this->Give(exporter);
  EXPECT_THROW(exporter->Export("maps"), itk::ExceptionObject);
  const auto map = itk::Image<double, 2>::New();
  map->SetRegions(itk::Size<2>{ { 2, 1 } });
  EXPECT_THROW(exporter->SetMaps(map, map), itk::ExceptionObject) << "no pixels";
  map->Allocate();
  map->SetPixel({ { 0, 0 } }, 64.0);
  map->SetPixel({ { 1, 0 } }, 65.0);
  exporter->SetMaps(map, map);
  exporter->Export("maps");
  sensornoise::CameraNoise expected = sensornoise::ReadCameraNoise(m_Report);
  expected.maps = { 2, 1, { 64.0, 65.0 }, { 64.0, 65.0 } };
  const auto made = sensornoise::ExportNoise("maps", { expected });
  ASSERT_EQ(exporter->GetNumberOfFiles(), made.files.size());
  for (unsigned int i = 0; i < exporter->GetNumberOfFiles(); ++i)
  {
    EXPECT_EQ(exporter->GetFileBytes(i), made.files[i].bytes);
  }
}

TEST_F(NoiseModelExporter, WritesTheTagIntoACopyOfAFile)
{
  const std::string name = (std::filesystem::temp_directory_path() / "NoiseModelExporterGTest.dng").string();
  const std::string dng = sensornoise::test::DngOfLevels(65, 1089);
  std::ofstream(name, std::ios::binary) << dng;
  const auto exporter = itk::NoiseModelExporter::New();
  this->Give(exporter);
  exporter->SetDngFile(name);
  exporter->Export("dng");
  sensornoise::ExportSettings levels;
  levels.blackLevelDn = 65.0;
  levels.whiteLevelDn = 1089.0;
  const auto profile = sensornoise::NoiseProfileOf(sensornoise::ReadCameraNoise(m_Report, levels));
  EXPECT_EQ(exporter->GetFileBytes(0), sensornoise::WithNoiseProfile(dng, profile));
  exporter->SetWhiteLevel(white);
  EXPECT_THROW(exporter->Export("dng"), itk::ExceptionObject) << "another white level";
  EXPECT_THROW(exporter->Export("fits"), itk::ExceptionObject);
  EXPECT_EQ(exporter->GetNumberOfFiles(), 0U) << "a failed export leaves no files";
  std::filesystem::remove(name);
  EXPECT_THROW(exporter->Export("dng"), itk::ExceptionObject);
  std::ostringstream printed;
  exporter->Print(printed);
  EXPECT_NE(printed.str().find("NoiseModelExporterGTest.dng"), std::string::npos);
}
