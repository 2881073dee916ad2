// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ChannelReports.h"

#include "sensornoise/ReportText.h"
#include "report/Quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <utility>

using namespace sensornoise;

namespace
{
/** Reports with these offsets, and a standard error of 2 DN each. */
std::array<Report, 4>
WithOffsets(const std::array<double, 4> & offsetsDn, double errorDn = 2.0)
{
  std::array<Report, 4> reports;
  for (std::size_t k = 0; k < reports.size(); ++k)
  {
    reports[k].method = "refined";
    reports[k].offset = WithError(offsetsDn[k], errorDn);
    reports[k].gain = WithError(1.0, 0.01);
  }
  return reports;
}

ChannelReports
Join(std::array<Report, 4> reports, BayerSource source = BayerSource::Given)
{
  return MakeChannelReports(BayerPattern::GBRG, source, std::move(reports));
}

bool
Warns(const ChannelReports & reports, WarningCode code)
{
  return std::any_of(
    reports.warnings.begin(), reports.warnings.end(), [code](const Warning & warning) { return warning.code == code; });
}
} // namespace

namespace
{
/** The levels of the planes R, G1, G2 and B [DN]. */
ChannelReports
JoinLevels(const std::array<double, 4> & levelsDn)
{
  std::array<Report, 4> reports;
  for (std::size_t k = 0; k < reports.size(); ++k)
  {
    reports[k].scatter.mean = { 0.5 * levelsDn[k], 1.5 * levelsDn[k] };
    reports[k].scatter.count = { 100, 100 };
  }
  return Join(std::move(reports));
}
} // namespace

TEST(ChannelReports, LevelsContradictAPatternWhoseGreensAreTheOtherColours)
{
  EXPECT_TRUE(Warns(JoinLevels({ 901.0, 706.0, 515.0, 899.0 }), WarningCode::BayerPatternDiffers));
  EXPECT_TRUE(Warns(JoinLevels({ 901.0, 515.0, 706.0, 899.0 }), WarningCode::BayerPatternDiffers));
  for (const std::array<double, 4> & sound : { std::array<double, 4>{ 706.0, 901.0, 899.0, 515.0 }, // the sensor's
                                               std::array<double, 4>{ 515.0, 901.0, 899.0, 706.0 }, // R is B
                                               std::array<double, 4>{ 600.0, 902.0, 898.0, 600.0 }, // grey light
                                               std::array<double, 4>{ 900.0, 901.0, 899.0, 900.5 }, // no colours
                                               std::array<double, 4>{ 700.0, 900.0, 860.0, 500.0 } })
  {
    EXPECT_FALSE(Warns(JoinLevels(sound), WarningCode::BayerPatternDiffers)) << sound[0];
  }
}

TEST(ChannelReports, FourEqualOffsetsAreTwiceAsPrecise)
{
  const ChannelReports reports = Join(WithOffsets({ 101.0, 99.0, 100.5, 99.5 }));
  ASSERT_TRUE(reports.joint);
  EXPECT_DOUBLE_EQ(*reports.joint->offset.value, 100.0);
  EXPECT_DOUBLE_EQ(*reports.joint->offset.standardError, 1.0);
  EXPECT_DOUBLE_EQ(*reports.joint->precisionGain, 2.0);
  EXPECT_DOUBLE_EQ(reports.joint->reducedChi2, 2.5 / 4.0 / 3.0);
  EXPECT_TRUE(reports.warnings.empty());
}

TEST(ChannelReports, OffsetsAreWeighedByTheirErrors)
{
  auto channels = WithOffsets({ 100.0, 104.0, 0.0, 0.0 });
  channels[1].offset = WithError(104.0, 4.0);
  channels[2].offset = Quantity::Without(EstimateStatus::NotIdentifiable);
  channels[3].offset = Quantity::Without(EstimateStatus::Failed);
  const ChannelReports reports = Join(channels);
  ASSERT_TRUE(reports.joint);
  EXPECT_DOUBLE_EQ(*reports.joint->offset.value, 100.8); // weights 1/4 and 1/16
  EXPECT_DOUBLE_EQ(*reports.joint->offset.standardError, std::sqrt(3.2));
}

TEST(ChannelReports, MoreScatterThanChanceIsInTheJointError)
{
  // chi2 is 12 over 3: the error is twice as large, and no better than one channel's.
  const ChannelReports reports = Join(WithOffsets(
    { 100.0 + std::sqrt(12.0), 100.0 - std::sqrt(12.0), 100.0 + std::sqrt(12.0), 100.0 - std::sqrt(12.0) }));
  EXPECT_NEAR(reports.joint->reducedChi2, 4.0, 1e-12);
  const ChannelReports far = Join(WithOffsets({ 110.0, 90.0, 110.0, 90.0 }));
  EXPECT_EQ(far.joint->offset.status, EstimateStatus::Failed);
  EXPECT_FALSE(far.joint->precisionGain);
  EXPECT_TRUE(Warns(far, WarningCode::OffsetsDiffer));
  EXPECT_NE(MakeTable(far).find("joint offset: none"), std::string::npos);
}

TEST(ChannelReports, AGivenOffsetIsNotFourMeasurements)
{
  auto channels = WithOffsets({ 100.0, 100.0, 100.0, 100.0 });
  for (Report & channel : channels)
  {
    channel.settings.emplace_back("dark_frames", 0.0);
  }
  EXPECT_FALSE(Join(channels).joint);
  for (Report & channel : channels)
  {
    channel.settings.back().second = 8.0; // each plane's dark pixels are its own
  }
  EXPECT_TRUE(Join(channels).joint);
}

TEST(ChannelReports, GreensAreExpectedAlike)
{
  auto channels = WithOffsets({ 100.0, 100.0, 100.0, 100.0 });
  channels[1].gain = WithError(1.02, 0.01);
  EXPECT_FALSE(Warns(Join(channels), WarningCode::GreensDiffer)); // 1.4 errors
  channels[1].gain = WithError(1.05, 0.01);
  EXPECT_TRUE(Warns(Join(channels), WarningCode::GreensDiffer));
  channels[1].gain = WithError(1.004, 1e-4);
  channels[2].gain = WithError(1.0, 1e-4);
  EXPECT_FALSE(Warns(Join(channels), WarningCode::GreensDiffer)); // certain, and too small to matter
  channels[0].gain = WithError(1.3, 0.01);
  EXPECT_FALSE(Warns(Join(channels), WarningCode::GreensDiffer)); // red may have another gain
}

TEST(ChannelReports, RecordHasFourNamedReports)
{
  auto channels = WithOffsets({ 100.0, 100.0, 100.0, 100.0 });
  channels[0].bitDepth = 11;
  channels[1].bitDepth = 12;
  const ChannelReports reports = Join(channels, BayerSource::Levels);
  EXPECT_TRUE(Warns(reports, WarningCode::RedOrBlue));
  EXPECT_EQ(reports.Of(BayerPlane::R).bitDepth, 12); // bit depth of one converter
  EXPECT_FALSE(reports.Of(BayerPlane::B).bitDepth);
  const std::string text = ToJson(reports);
  std::size_t       place = text.find(R"("bayer": {"pattern": "GBRG", "source": "levels"})");
  EXPECT_NE(place, std::string::npos);
  for (const char * name : { "R", "G1", "G2", "B" })
  {
    place = text.find(std::string(R"("channel": ")") + name + '"', place);
    EXPECT_NE(place, std::string::npos) << name;
  }
  EXPECT_NE(text.find(R"("precision_gain": 2,)"), std::string::npos);
}

TEST(ChannelReports, TableHasALineAChannel)
{
  auto channels = WithOffsets({ 100.0, 100.0, 100.0, 100.0 });
  channels[0].vibrationSdX = UpperLimit(0.0123);
  channels[3].warnings.push_back({ WarningCode::FewFrames, "only 8 frames" });
  channels[0].warnings.push_back({ WarningCode::FewFrames, "only 8 frames" });
  channels[0].warnings.push_back({ WarningCode::NotStatic, "2 % of the pixels" });
  const ChannelReports reports = Join(channels);
  const std::string    table = MakeTable(reports);
  for (const char * expected : { "planes of 0 x 0 pixels of a GBRG mosaic",
                                 "\nchannel  gain g",
                                 "\nR        1.000 \u00B1 0.010  100.0 \u00B1 2.0",
                                 "\nG1 ",
                                 "\nG2 ",
                                 "\nB  ",
                                 "< 0.0123",
                                 "joint offset: 100.0 \u00B1 1.0 DN, 2 times as precise" })
  {
    EXPECT_NE(table.find(expected), std::string::npos) << expected << "\n" << table;
  }
  EXPECT_NE(MakeText(reports).find("warning: R, B: only 8 frames [few-frames]"), std::string::npos);
  EXPECT_FALSE(Join(std::array<Report, 4>{}).IsUsable());
  EXPECT_TRUE(reports.IsUsable());
}
