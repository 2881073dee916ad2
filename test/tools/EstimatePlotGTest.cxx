// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <set>
#include <string>

namespace
{
/** What --plot writes. */
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
  EXPECT_NE(ReadText(Path("p.html")).find("Not measured."), std::string::npos);
}

TEST_F(EstimatePlotTool, NoFileThatIsReadOrWrittenIsReplaced)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(Run(stack + " --plot p.png"), 2);
  EXPECT_NE(m_Message.find("p.png ends in neither .html nor .svg; expected for example report.html"), std::string::npos)
    << m_Message;
  EXPECT_EQ(Run(stack + " --json r.html --plot r.html"), 2);
  EXPECT_NE(m_Message.find("cannot write r.html (--plot): it is the same file as"), std::string::npos) << m_Message;
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
}
