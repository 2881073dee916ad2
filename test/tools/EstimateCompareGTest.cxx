// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <set>
#include <string>

namespace
{
/** --compare: several stored reports on one page. */
class EstimateCompareTool : public EstimateToolTest
{
protected:
  /** Writes a stored report, whose record \a edit changes. */
  template <typename TEdit>
  std::string
  WriteReport(const std::string & name, const std::string & arguments, TEdit edit)
  {
    nlohmann::json record = ReportOf(arguments);
    edit(record);
    return WriteText(name, record.dump());
  }
  bool
  PageHas(const std::string & part) const
  {
    return ReadText(Path("p.html")).find(part) != std::string::npos;
  }
};
const auto AsItIs = [](nlohmann::json &) {};
} // namespace

TEST_F(EstimateCompareTool, WhatChangedStandsOnThePage)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  WriteReport("day1.json", stack, AsItIs);
  WriteReport("day2.json", stack, [](nlohmann::json & record) {
    record["gain"]["value"] = 1.5 * record["gain"]["value"].get<double>();
    record["camera"] = { { "name", "Cam" }, { "iso_speed", 200 }, { "exposure_seconds", 0.02 } };
  });
  ASSERT_EQ(Run("--compare day1.json day2.json --plot p.html"), 0) << m_Message;
  EXPECT_TRUE(PageHas("gain g in one report (by up to 50\u00A0%)"));
  EXPECT_TRUE(PageHas("Cam, ISO 200, 0.02 s, 24 frames of 64 \u00D7 64 pixels"));
  EXPECT_TRUE(PageHas(">2 day2</text>"));
  EXPECT_NE(m_Output.find("+50 % of the first; changed by more than its errors"), std::string::npos) << m_Output;
  EXPECT_EQ(m_Message, "");
  ASSERT_EQ(Run("--plot p.svg --quiet --compare day1.json day1.json"), 0) << m_Message;
  EXPECT_EQ(m_Output, "");
  EXPECT_EQ(ReadText(Path("p.svg")).rfind("<svg ", 0), 0U);
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha", "day1.json", "day2.json", "p.html", "p.svg" }));
}

TEST_F(EstimateCompareTool, MosaicsHaveARowPerChannelAndMethodsWithoutErrorsNoVerdict)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  ASSERT_EQ(Run(stack + " --method published --quiet --json published.json"), 0) << m_Message;
  ASSERT_EQ(Run(stack + " --method published --bayer RGGB --quiet --json mosaic.json"), 0) << m_Message;
  std::filesystem::create_directory(Path("night"));
  std::filesystem::copy(Path("published.json"), Path("night/published.json"));
  ASSERT_EQ(Run("--compare mosaic.json published.json night/published.json --plot p.html"), 0) << m_Message;
  for (const char * const part : { "1 mosaic R", "4 mosaic B", "5 published<", "6 night/published", "not tested" })
  {
    EXPECT_TRUE(PageHas(part)) << part;
  }
}

TEST_F(EstimateCompareTool, FailedReportsAreShownAsThat)
{
  const std::string constant = Write("s.mha", Make<StackType>({ { 32, 32, 10 } }, 500).GetPointer());
  ASSERT_EQ(Run(constant + " --quiet --json failed.json"), 3);
  EXPECT_EQ(Run("--compare failed.json failed.json --plot p.html"), 3) << m_Message;
  EXPECT_TRUE(PageHas("Nothing can be compared"));
}

TEST_F(EstimateCompareTool, WhatIsNoReportIsRefusedInASentence)
{
  const std::string report = WriteReport("r.json", Write("s.mha", MakeBurst().GetPointer()), AsItIs);
  const auto        refuses = [this, &report](const std::string & other, const std::string & part) {
    SCOPED_TRACE(other);
    const auto before = FilesLeft();
    EXPECT_EQ(Run("--compare " + report + " " + other + " --plot p.html"), 2) << m_Message;
    SaysInOneSentence({ part });
    EXPECT_EQ(FilesLeft(), before);
  };
  refuses("none.json", "the report none.json cannot be read: No such file");
  refuses(WriteText("bad.json", "{\"schema\": "), "the report bad.json is no JSON");
  refuses(WriteText("other.json", R"({"schema": "other/1"})"), "has the schema \"other/1\"; expected");
  refuses(WriteText("short.json", R"({"schema": "itk-sensornoise-report/1", "channel": "mono"})"), "has no gain;");
  refuses(WriteText("list.json", R"({"schema": "itk-sensornoise-report/1", "channels": [1]})"), "that is no report");
  refuses("", "there is one report; expected two or more");
  refuses(report + " --bayer none", "it reads stored reports and measures nothing; leave out --bayer");
  EXPECT_EQ(Run("s.mha --compare r.json r.json"), 2);
  SaysInOneSentence({ "leave out FRAME" });
  EXPECT_EQ(Run("--compare r.json r.json --plot r.json"), 2);
  EXPECT_EQ(Run(""), 2);
  SaysInOneSentence({ "no FRAME was given" });
}
