// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Comparison.h"
#include "helpers/PageTestHelper.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
Quantity
Value(double value, double standardError)
{
  Quantity quantity = Quantity::Identified(value);
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - 1.96 * standardError, value + 1.96 * standardError };
  return quantity;
}

/** Gain 1 ± 0.03, read noise 20 ± 0.1, offset 100 ± 0.3, all others the same. */
ComparedReport
MakeReport(const std::string & label)
{
  Report report;
  report.method = "refined";
  report.frames = 50;
  report.gain = report.varianceSlope = Value(1.0, 0.03);
  report.readNoise = report.readNoiseElectrons = Value(20.0, 0.1);
  report.offset = Value(100.0, 0.3);
  report.intercept = report.totalIntercept = Value(300.0, 3.0);
  return { label, report };
}

const ComparedQuantity &
QuantityOf(const Comparison & comparison, const std::string & path)
{
  return *std::find_if(comparison.quantities.begin(),
                       comparison.quantities.end(),
                       [&path](const ComparedQuantity & quantity) { return quantity.entry->path == path; });
}

/** Returns the change of the gain from the first report to the second. */
Change
ChangeOfGain(const Quantity & first, const Quantity & second)
{
  ComparedReport a = MakeReport("a");
  ComparedReport b = MakeReport("b");
  a.report.gain = first;
  b.report.gain = second;
  return QuantityOf(MakeComparison({ a, b }), "gain").changes[1];
}
} // namespace

TEST(SensorNoiseComparison, ADifferenceHasBothErrorsAndItsSize)
{
  const Change within = ChangeOfGain(Value(2.0, 0.03), Value(2.1, 0.04));
  EXPECT_DOUBLE_EQ(*within.standardError, 0.05);
  EXPECT_NEAR(*within.difference, 0.1, 1e-15);
  EXPECT_NEAR(*within.fraction, 0.05, 1e-15);
  EXPECT_EQ(within.kind, ChangeKind::Within);
  EXPECT_EQ(ChangeOfGain(Value(2.0, 0.03), Value(1.84, 0.04)).kind, ChangeKind::Changed); // 3.2 errors, 8 %
  const Change small = ChangeOfGain(Value(2.0, 0.0003), Value(2.016, 0.0004));            // 32 errors, 0.8 %
  EXPECT_EQ(small.kind, ChangeKind::Small);
  EXPECT_NEAR(*small.fraction, 0.008, 1e-12);
}

TEST(SensorNoiseComparison, AnOffsetIsLargeBesideTheReadNoise)
{
  for (const bool isSmall : { false, true })
  {
    ComparedReport b = MakeReport("b");
    b.report.offset = Value(isSmall ? 98.2 : 97.8, 0.4); // 3.6 and 4.4 errors; 9 % and 11 % of the read noise
    const Change change = QuantityOf(MakeComparison({ MakeReport("a"), b }), "offset").changes[1];
    EXPECT_NEAR(*change.fraction, isSmall ? -0.09 : -0.11, 1e-12);
    EXPECT_EQ(change.kind, isSmall ? ChangeKind::Small : ChangeKind::Changed);
  }
}

TEST(SensorNoiseComparison, OnlyAValueWithAnErrorHasAVerdict)
{
  const Change published = ChangeOfGain(Quantity::Identified(2.0), Quantity::Identified(3.0));
  EXPECT_EQ(published.kind, ChangeKind::NoErrors);
  EXPECT_EQ(*published.difference, 1.0);
  EXPECT_FALSE(published.standardError);
  EXPECT_EQ(ChangeOfGain(Value(2.0, 0.1), Quantity::Identified(3.0)).kind, ChangeKind::NoErrors);
  EXPECT_EQ(ChangeOfGain(Value(2.0, 0.0), Value(2.0, 0.0)).kind, ChangeKind::NoErrors); // given, not measured
  const Change failed = ChangeOfGain(Value(2.0, 0.1), Quantity::Without(EstimateStatus::Failed));
  EXPECT_EQ(failed.kind, ChangeKind::NoValue);
  EXPECT_FALSE(failed.difference);
  // a quantity that may be 0 has no fraction
  EXPECT_FALSE(ChangeOfGain(Value(0.1, 0.1), Value(5.0, 0.1)).fraction);
}

TEST(SensorNoiseComparison, AChannelIsComparedWithItsOwn)
{
  std::vector<ComparedReport> rows;
  for (const char * const file : { "a", "b" })
  {
    for (const char * const channel : { "R", "G1", "G2", "B" })
    {
      rows.push_back(MakeReport(file));
      rows.back().report.channel = channel;
    }
  }
  rows[5].report.gain = Value(2.0, 0.03);
  const Comparison comparison = MakeComparison(rows);
  const auto &     changes = QuantityOf(comparison, "gain").changes;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    EXPECT_EQ(changes[row].first, row % 4);
    EXPECT_EQ(changes[row].kind, row < 4 ? ChangeKind::First : row == 5 ? ChangeKind::Changed : ChangeKind::Within);
  }
  const std::string page = ToHtml(comparison);
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "against the first report: gain g in one report (by up to 100\u00A0%)."));
}

TEST(SensorNoiseComparison, ScatterIsDistinguishedFromChance)
{
  const auto meanOf = [](double error) {
    std::vector<ComparedReport> rows{ MakeReport("a"), MakeReport("b"), MakeReport("c") };
    for (int i = 0; i < 3; ++i)
    {
      rows[static_cast<std::size_t>(i)].report.gain = Value(1.0 + i, error);
    }
    return QuantityOf(MakeComparison(rows), "gain").means.at(0);
  };
  const CommonMean chance = meanOf(1.0);
  EXPECT_DOUBLE_EQ(chance.mean, 2.0);
  EXPECT_DOUBLE_EQ(chance.standardError, 1.0 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(chance.chiSquare, 2.0);
  EXPECT_NEAR(chance.probability, std::exp(-1.0), 1e-12);
  EXPECT_EQ(chance.excess, 0.0);
  const CommonMean beyond = meanOf(0.1); // the errors explain 0.01 of a variance of 1
  EXPECT_NEAR(beyond.chiSquare, 200.0, 1e-9);
  EXPECT_NEAR(beyond.excess, std::sqrt(0.99), 1e-9);
  EXPECT_TRUE(QuantityOf(MakeComparison({ MakeReport("a"), MakeReport("b") }), "gain").means.empty());
}

TEST(SensorNoiseComparison, ThePageSaysWhatEachReportIs)
{
  ComparedReport changed = MakeReport("ISO <400> & \"more\" of a very long name that ends in 7");
  changed.report.camera.camera = "Camera <X>";
  changed.report.camera.isoSpeed = 400;
  changed.report.camera.exposureSeconds = 0.01;
  changed.report.gain = Value(1.5, 0.04);
  changed.report.offset = Value(110.0, 0.4);
  changed.report.Warn(WarningCode::FewFrames, "few");
  ComparedReport published = MakeReport("published");
  published.report.gain = published.report.varianceSlope = Quantity::Identified(1.1);
  ComparedReport failed = MakeReport("failed");
  failed.report = Report();
  failed.report.readNoise = Quantity::Without(EstimateStatus::UpperLimit);
  failed.report.readNoise.interval95 = Interval{ 0.0, 1.25 };
  failed.report.offset = Quantity::Without(EstimateStatus::NotIdentifiable);
  failed.report.offset.bracket = Interval{ std::nullopt, 120.0 };
  failed.report.totalIntercept.value = std::numeric_limits<double>::quiet_NaN();
  const Comparison  comparison = MakeComparison({ MakeReport("first"), changed, published, failed });
  const std::string page = ToHtml(comparison);
  ExpectSound(page);
  for (const char * const part : { "Changed.",
                                   "Without a gain: 4.",
                                   "+0.500 \u00B1 0.050 DN/e\u207B",
                                   "+50\u00A0% of the first",
                                   "+50\u00A0% of the read noise",
                                   "changed by more than its errors: 10 standard errors",
                                   "Camera &lt;X&gt;, ISO 400, 0.01 s, 50 frames",
                                   "warnings: few-frames",
                                   "not tested: there are no errors",
                                   "not compared: no value (failed)",
                                   ">&lt; 1.25 (upper limit)</text>",
                                   ">not identifiable: at most 120</text>",
                                   ">failed</text>",
                                   ">2 ISO &lt;400\u2026nds in 7</text>" })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  const std::string text = MakeText(comparison);
  EXPECT_EQ(text.find("\u00A0"), std::string::npos) << text;
  EXPECT_TRUE(Contains(text, "+0.500 \u00B1 0.050 DN/e\u207B, +50 % of the first; changed by more than its errors"))
    << text;
  const std::string svg = ToSvg(comparison);
  EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
  EXPECT_EQ(FaultOfTags(svg), "");
}

TEST(SensorNoiseComparison, WhatIsExtremeBreaksNothing)
{
  const std::vector<double>   numbers{ 1e308, -1e308, 1e-308, 0.0, 1e50, std::numeric_limits<double>::quiet_NaN() };
  std::vector<ComparedReport> rows;
  for (const double value : numbers)
  {
    for (const double error : numbers)
    {
      rows.push_back(MakeReport("a"));
      Quantity quantity = Quantity::Identified(value);
      quantity.standardError = error;
      rows.back().report.gain = rows.back().report.offset = rows.back().report.readNoise = quantity;
    }
  }
  ExpectSound(ToHtml(MakeComparison(rows)));
  std::reverse(rows.begin(), rows.end());
  ExpectSound(ToHtml(MakeComparison(rows)));
}

TEST(SensorNoiseComparison, WithoutValuesNothingIsCompared)
{
  const Comparison  comparison = MakeComparison({ { "a", Report() }, { "b", Report() } });
  const std::string page = ToHtml(comparison);
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "Not compared."));
  EXPECT_FALSE(Contains(page, "<svg"));
  EXPECT_EQ(FaultOfTags(ToSvg(comparison)), "");
  const std::string same = ToHtml(MakeComparison({ MakeReport("a"), MakeReport("b") }));
  EXPECT_TRUE(Contains(same, "No change."));
  EXPECT_TRUE(Contains(same, "Nothing differs from the first report by more than its errors."));
}
