// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportPage.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <string>

using namespace sensornoise;

TEST(SensorNoiseFigureJson, HasEveryArrayAndNullForNaN)
{
  Report report;
  report.gain = report.varianceSlope = Quantity::Identified(2.0);
  report.totalIntercept = Quantity::Identified(10.0);
  report.scatter = { { 32.0 }, { std::numeric_limits<double>::quiet_NaN() }, { 74.5 }, { 100 } };
  report.flicker = { 0.5, -0.5 };
  report.motion = { { 0.25, -1.0 } };
  report.noiseCorrelation.emplace();
  report.noiseCorrelation->space.push_back({ 1, 0, 0, 0.5, 0.25 });
  report.noiseCorrelation->time.push_back({ 0, 0, 2, -0.5, 0.125 });

  std::string text = FigureAsJson(report);
  for (const std::string name : { "line_mean", "line_variance" }) // 33 times the same: the curve has one level
  {
    const std::size_t begin = text.find("\"" + name + "\": [") + name.size() + 5;
    const std::size_t end = text.find(']', begin);
    EXPECT_EQ(text.substr(begin, 4), name == "line_mean" ? "32, " : "74, ");
    text.erase(begin, end - begin);
  }
  EXPECT_EQ(text,
            "{\"mean\": [32], \"variance\": [null], \"corrected_variance\": [74.5], \"residual_mean\": [], "
            "\"residual\": [], \"residual_spread\": 1.1726039399558574, \"line_mean\": [], \"line_variance\": [], "
            "\"band_low\": [], \"band_high\": [], "
            "\"is_indicative\": false, \"flicker\": [0.5, -0.5], \"motion_x\": [0.25], \"motion_y\": [-1], "
            "\"lags\": [{\"lag\": [1, 0], \"value\": 0.5, \"standard_error\": 0.25}, "
            "{\"lag\": 2, \"value\": -0.5, \"standard_error\": 0.125}]}\n");
}

TEST(SensorNoiseFigureJson, OfAMosaicHasAnObjectAChannel)
{
  std::array<Report, 4> channels;
  channels[1].flicker = { 0.25 };
  const auto        reports = MakeChannelReports(BayerPattern::RGGB, BayerSource::Given, channels);
  const std::string text = FigureAsJson(reports);
  std::string       expected;
  for (const Report & report : reports.channels)
  {
    const std::string figure = FigureAsJson(report);
    expected += (expected.empty() ? "{\"" : ", \"") + report.channel + "\": " + figure.substr(0, figure.size() - 1);
  }
  EXPECT_EQ(text, expected + "}\n");
  EXPECT_NE(text.find("\"G1\": {"), std::string::npos);
}
