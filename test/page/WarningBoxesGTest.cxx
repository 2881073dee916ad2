// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/PageTestHelper.h"
#include "page/PageSections.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/WarningCodes.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoiseWarningBoxes, TheActionIsTheCommandAtTheEnd)
{
  const char * lookAtTheMap = "Look at the map of pixel use (--maps) to see where they are.";
  const auto   expect = [](WarningCode code, const char * message, const char * finding, const char * action) {
    const WarningParts parts = SplitWarning({ code, message });
    EXPECT_EQ(parts.finding, finding);
    EXPECT_EQ(parts.action, action);
  };
  expect(WarningCode::FewFrames,
         "only 15 distinct frames, of 9.5 s. Record at least 20",
         "Only 15 distinct frames, of 9.5 s.",
         "Record at least 20.");
  expect(WarningCode::NotStatic,
         "1.2 % move. Choose another part. Use --roi",
         "1.2 % move.",
         "Choose another part. Use --roi.");
  expect(WarningCode::FlickerNotIdentifiable,
         "the flicker is not known: give the offset (--offset)",
         "The flicker is not known.",
         "Give the offset (--offset).");
  // the table has the action of a warning whose message has none
  expect(WarningCode::FewFrames, "only 15 frames", "Only 15 frames.", "Record at least 20.");
  expect(WarningCode::NotStatic, "1.2 % move. They are left out", "1.2 % move. They are left out.", lookAtTheMap);
  expect(WarningCode::NotStatic, "Use --roi", "Use --roi.", lookAtTheMap);
}

TEST(SensorNoiseWarningBoxes, EveryWarningOfTheTableHasAnAction)
{
  for (const WarningKind & kind : WarningTable)
  {
    const WarningParts parts = SplitWarning({ kind.code, kind.sentence });
    EXPECT_FALSE(parts.action.empty()) << kind.name;
    EXPECT_FALSE(parts.finding.empty()) << kind.name;
    EXPECT_EQ(parts.finding + " " + parts.action, kind.sentence) << kind.name;
  }
}

TEST(SensorNoiseWarningBoxes, EveryWarningStandsOnceErrorsFirst)
{
  Report report;
  for (const WarningKind & kind : WarningTable)
  {
    report.Warn(kind.code, "found <" + std::string(kind.name) + "> & \"more\"");
  }
  const std::string boxes = WarningBoxes(report.warnings);
  EXPECT_EQ(FaultOfTags(boxes), "");
  for (const WarningKind & kind : WarningTable)
  {
    EXPECT_EQ(CountOf(boxes, "Found &lt;" + std::string(kind.name) + "&gt; &amp; &quot;more&quot;.</p>"), 1U);
    EXPECT_EQ(CountOf(boxes, "id=\"" + std::string(kind.name) + "\""), 1U);
  }
  EXPECT_LT(boxes.rfind("warning is-error"), boxes.find("warning is-warning"));
  EXPECT_LT(boxes.rfind("warning is-warning"), boxes.find("warning is-note"));
}

TEST(SensorNoiseWarningBoxes, ChannelsShareABoxAndItsAction)
{
  std::array<Report, 4> channels;
  channels[0].Warn(WarningCode::FewFrames, "only 7 frames. Record at least 20");
  channels[1].Warn(WarningCode::FewFrames, "only 8 frames. Record at least 20");
  const ChannelReports reports = MakeChannelReports(BayerPattern::RGGB, BayerSource::Given, channels);
  const std::string    boxes = WarningBoxes(WarningsOf(reports));
  EXPECT_EQ(CountOf(boxes, "id=\"few-frames\""), 1U);
  EXPECT_EQ(CountOf(boxes, "only 7 frames."), 1U);
  EXPECT_EQ(CountOf(boxes, "only 8 frames."), 1U);
  EXPECT_EQ(CountOf(boxes, "Record at least 20."), 1U);
}

TEST(SensorNoiseWarningBoxes, TheVerdictLinksToWhatLimitsIt)
{
  Report report;
  report.gain = Quantity::Identified(1.0);
  EXPECT_EQ(VerdictBox(report),
            "<p class=\"verdict is-note\"><span class=\"word\">Measured, without warnings</span>.</p>\n");
  report.Warn(WarningCode::NotStatic, "something moves");
  EXPECT_EQ(VerdictBox(report),
            "<p class=\"verdict is-note\"><span class=\"word\">Measured; these effects are allowed for</span>: <a "
            "href=\"#not-static\">not static</a>.</p>\n");
  report.Warn(WarningCode::FewFrames, "only 7 frames");
  report.Warn(WarningCode::PoorFit, "a poor fit");
  EXPECT_EQ(VerdictBox(report),
            "<p class=\"verdict is-warning\"><span class=\"word\">Measured, with 2 warnings</span>: <a "
            "href=\"#few-frames\">few frames</a>, <a href=\"#poor-fit\">poor fit</a>.</p>\n");
  report.gain = Quantity::Without(EstimateStatus::Failed);
  report.Warn(WarningCode::Contradicted, "contradicted");
  EXPECT_EQ(VerdictBox(report),
            "<p class=\"verdict is-error\"><span class=\"word\">Not measured</span>: <a "
            "href=\"#contradicted\">contradicted</a>.</p>\n");
}
