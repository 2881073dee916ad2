// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <set>
#include <string>

namespace
{
/** Tests of the files that --plot writes. */
class EstimatePlotTool : public EstimateToolTest
{};
} // namespace

TEST_F(EstimatePlotTool, AReportIsAPageOrAFigure)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  ASSERT_EQ(Run(stack + " --plot p.html"), 0) << m_Message;
  const std::string page = ReadText(Path("p.html"));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_NE(page.find("alt=\"map of pixel use\""), std::string::npos);
  ASSERT_EQ(Run(stack + " --plot P.SVG --json r.json"), 0) << m_Message;
  const std::string figure = ReadText(Path("P.SVG"));
  EXPECT_EQ(figure.rfind("<svg ", 0), 0U);
  EXPECT_NE(figure.find("</svg>"), std::string::npos);
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha", "p.html", "P.SVG", "r.json" }));
}

TEST_F(EstimatePlotTool, AFailedMeasurementHasAPage)
{
  const std::string constant = Write("s.mha", Make<StackType>({ { 32, 32, 10 } }, 500).GetPointer());
  ASSERT_EQ(Run(constant + " --plot p.html"), 3) << m_Message;
  EXPECT_NE(ReadText(Path("p.html")).find(">Not measured</span>"), std::string::npos);
}

TEST_F(EstimatePlotTool, NoFileThatIsReadOrWrittenIsReplaced)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(Run(stack + " --plot p.jpg"), 2);
  EXPECT_NE(m_Message.find("p.jpg ends in none of .html, .svg and .png; expected for example report.html"),
            std::string::npos)
    << m_Message;
  EXPECT_EQ(Run(stack + " --json r.html --plot r.html"), 2);
  EXPECT_NE(m_Message.find("cannot write r.html (--plot): it is the same file as"), std::string::npos) << m_Message;
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
}

TEST_F(EstimatePlotTool, APngIsTheFigureAtTwiceItsSize)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
#ifdef SENSORNOISE_LIBRSVG
  ASSERT_EQ(Run(stack + " --plot p.PNG"), 0) << m_Message;
  const std::string png = ReadText(Path("p.PNG"));
  ASSERT_GT(png.size(), 1000U);
  EXPECT_EQ(png.substr(0, 16), std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x05\xa0", 4)); // 1440: 2 x 720
#else
  EXPECT_EQ(Run(stack + " --plot p.png"), 2);
  SaysInOneSentence({ "cannot write p.png: this program was built without librsvg", "librsvg2-dev" });
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
#endif
}

#ifdef SENSORNOISE_OPENSSL
TEST_F(EstimatePlotTool, TheHashIsThatOfTheFilesInTheirOrder)
{
  // FIPS 180-2, appendix B.3: a million letters a; as one dump, and as a list of files
  const std::string known = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
  WriteText("a.raw", std::string(1000000, 'a'));
  const auto one = ReportOf("--raw 100x100:uint8 a.raw --hash --plot p.html", 3)["input"];
  EXPECT_EQ(one, (nlohmann::json{ { "of", "files" }, { "sha256", known }, { "files", 1 }, { "bytes", 1000000 } }));
  EXPECT_NE(ReadText(Path("p.html")).find("<code>" + known + "</code>"), std::string::npos);
  std::string names;
  for (int i = 0; i < 10; ++i)
  {
    names += WriteText("frame" + std::to_string(i) + ".raw", std::string(100000, 'a')) + " ";
  }
  const auto list = ReportOf("--raw 250x400:uint8 " + names + "--hash --dark frame0.raw frame1.raw", 3)["input"];
  EXPECT_EQ(list["sha256"], known);
  EXPECT_EQ(list["files"], 10);
  EXPECT_EQ(list["dark"]["bytes"], 200000);
  EXPECT_FALSE(ReportOf("--raw 100x100:uint8 a.raw", 3).contains("input"));
}

TEST_F(EstimatePlotTool, TheHashHasHeaderAndPixels)
{
  const std::string stack = Write("s.mhd", MakeBurst().GetPointer());
  if (RunCommand("cat s.mhd s.raw | sha256sum") != 0)
  {
    GTEST_SKIP() << "there is no sha256sum";
  }
  const std::string known = m_Output.substr(0, 64);
  EXPECT_EQ(ReportOf(stack + " --hash")["input"]["sha256"], known);
  // in the report of a mosaic it stands beside the channels
  const auto mosaic = ReportOf(stack + " --hash --bayer RGGB");
  EXPECT_EQ(mosaic["input"]["sha256"], known);
  EXPECT_FALSE(mosaic["channels"][0].contains("input"));
}
#else
TEST_F(EstimatePlotTool, WithoutOpenSslThePageSaysThatThereIsNoHash)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(Run(stack + " --hash"), 2);
  SaysInOneSentence({ "--hash: this program was built without OpenSSL" });
  ASSERT_EQ(Run(stack + " --plot p.html"), 0) << m_Message;
  EXPECT_NE(ReadText(Path("p.html")).find("not computed: built without OpenSSL"), std::string::npos);
}
#endif
