// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkNoiseProfileChecker.h"
#include "exports/NoiseProfile.h"
#include "helpers/ProfileTestHelper.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace
{
class NoiseProfileChecker : public ProfileTest
{
protected:
  void
  SetUp() override
  {
    ProfileTest::SetUp();
    const sensornoise::Report frames = Frames();
    m_Report.numbers["/frames_distinct"] = static_cast<double>(frames.framesDistinct);
    for (std::size_t i = 0; i < frames.scatter.mean.size(); ++i)
    {
      const std::string bin = "/" + std::to_string(i);
      m_Report.numbers["/scatter/mean" + bin] = frames.scatter.mean[i];
      m_Report.numbers["/scatter/corrected_variance" + bin] = frames.scatter.correctedVariance[i];
      m_Report.numbers["/scatter/count" + bin] = static_cast<double>(frames.scatter.count[i]);
    }
  }
  static void
  Give(const sensornoise::StoredReport & values, itk::NoiseProfileChecker * checker)
  {
    for (const auto & [pointer, number] : values.numbers)
    {
      checker->SetNumber(pointer, number);
    }
    for (const auto & [pointer, text] : values.texts)
    {
      checker->SetText(pointer, text);
    }
  }
  /** Returns a checker with the report of the frames. */
  itk::NoiseProfileChecker::Pointer
  Checker() const
  {
    auto checker = itk::NoiseProfileChecker::New();
    Give(m_Report, checker);
    checker->SetReport("of these frames");
    return checker;
  }
};
} // namespace

TEST_F(NoiseProfileChecker, ComparesAReportWithItself)
{
  const auto checker = this->Checker();
  Give(m_Report, checker);
  checker->SetProfileValues("report.json");
  checker->Check();
  ASSERT_EQ(checker->GetNumberOfChannels(), 1U);
  EXPECT_EQ(checker->GetChannel(0), "mono");
  EXPECT_EQ(checker->GetReason(0), "");
  EXPECT_NE(checker->GetCheckAsJson(0).find("\"verdict\": \"fits\""), std::string::npos) << checker->GetCheckAsJson(0);
  EXPECT_NE(checker->GetCheckAsText(0).find("this model can be used"), std::string::npos);
}

TEST_F(NoiseProfileChecker, FindsTheMistakeInAFile)
{
  const std::string name = (std::filesystem::temp_directory_path() / "NoiseProfileCheckerGTest.yaml").string();
  std::string       text = this->TextOf("pyme");
  const std::string key = "ElectronsPerCount: ";
  ASSERT_NE(text.find(key), std::string::npos) << text;
  const std::size_t begin = text.find(key) + key.size();
  text.replace(begin, text.find_first_of(",}\n ", begin) - begin, std::to_string(gain)); // its inverse is right
  std::ofstream(name) << text;
  const auto checker = this->Checker();
  checker->SetProfileFile(name);
  checker->Check();
  EXPECT_NE(checker->GetCheckAsText(0).find("e-/ADU and ADU/e- are exchanged"), std::string::npos)
    << checker->GetCheckAsText(0);
  std::filesystem::remove(name);
  EXPECT_THROW(checker->Check(), itk::ExceptionObject);
  EXPECT_EQ(checker->GetNumberOfChannels(), 0U) << "a failed check leaves no results";
  std::ostringstream printed;
  checker->Print(printed);
  EXPECT_NE(printed.str().find("NoiseProfileCheckerGTest.yaml"), std::string::npos);
}

TEST_F(NoiseProfileChecker, TakesTheLevelsOfTheFrames)
{
  const std::string name = (std::filesystem::temp_directory_path() / "NoiseProfileCheckerGTest.txt").string();
  std::ofstream(name) << this->TextOf("dng");
  m_Report.numbers.erase("/camera/white_level");
  const auto checker = this->Checker();
  checker->SetProfileFile(name);
  checker->Check();
  EXPECT_NE(checker->GetReason(0).find("--white"), std::string::npos) << checker->GetReason(0);
  checker->SetWhiteLevel(white);
  checker->Check();
  EXPECT_NE(checker->GetCheckAsJson(0).find("\"verdict\": \"fits\""), std::string::npos) << checker->GetCheckAsJson(0);
  checker->SetWhiteLevel(white / 2.0);
  checker->Check();
  EXPECT_NE(checker->GetCheckAsJson(0).find("\"verdict\": \"does-not-fit\""), std::string::npos);
  std::filesystem::remove(name);
}
