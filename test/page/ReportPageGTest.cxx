// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportPage.h"
#include "helpers/PageTestHelper.h"
#include "sensornoise/WarningCodes.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/** Variance is 0.5 mean + 20; with flicker it is above that. */
Report
MakeGoodReport(std::size_t frames)
{
  Report report;
  report.method = "refined";
  report.frames = report.framesDistinct = frames;
  report.width = 6000;
  report.height = 4000;
  report.clipHighDn = 4095.0;
  report.quantisationStepDn = 1.0;
  report.gain = report.varianceSlope = Quantity::Identified(0.5);
  report.gain.standardError = report.varianceSlope.standardError = 0.001;
  report.gain.interval95 = Interval{ 0.498, 0.502 };
  report.offset = Quantity::Identified(95.0);
  report.offset.standardError = 0.5;
  report.readNoise = Quantity::Identified(4.0);
  report.readNoise.standardError = 0.05;
  report.readNoiseElectrons = Quantity::Identified(8.0);
  report.intercept = report.totalIntercept = Quantity::Identified(20.0);
  report.intercept.standardError = report.totalIntercept.standardError = 0.2;
  report.covariance = { { { 1e-6, 0.0, 0.0 }, { 0.0, 0.04, 0.0 }, { 0.0, 0.0, 0.25 } } };
  report.fit.line = Report::Baseline{ 0.0, 0.5, 20.0 };
  for (int i = 0; i < 100; ++i)
  {
    const double mean = 100.0 + 30.0 * i;
    report.scatter.mean.push_back(mean);
    report.scatter.variance.push_back(0.5 * mean + 20.0 + 1e-4 * mean * mean);
    report.scatter.correctedVariance.push_back(0.5 * mean + 20.0 + (i % 2 == 0 ? 1.0 : -1.0));
    report.scatter.count.push_back(1000);
  }
  for (std::size_t t = 0; t < frames; ++t)
  {
    report.flicker.push_back(0.01 * std::sin(static_cast<double>(t)));
    report.motion.push_back({ 0.02 * std::cos(static_cast<double>(t)), -0.01 });
  }
  report.noiseCorrelation.emplace();
  report.noiseCorrelation->kind = "white";
  report.noiseCorrelation->space.push_back({ 1, 0, 0, 0.001, 0.002 });
  report.noiseCorrelation->time.push_back({ 0, 0, 1, -0.001, 0.002 });
  report.settings = { { "rolling_shutter", std::string("auto") }, { "offset", 1.5 }, { "any", true } };
  return report;
}
} // namespace

TEST(SensorNoiseReportPage, HoldsWhatWasFoundToItsErrors)
{
  const std::string page = ToHtml(MakeGoodReport(100));
  ExpectSound(page);
  for (const char * const part :
       { "<h1>Noise of an image sensor</h1>",
         "<span class=\"word\">Measured, without warnings</span>.",
         "<dt>Gain</dt><dd><b>0.5000</b> <span class=\"nowrap\">\u00B1&#160;0.0010 DN/e\u207B</span></dd><dd "
         "class=\"soft\">95 %: 0.4980 to 0.5020</dd>",
         "<dt>Read noise</dt><dd><b>8</b> <span class=\"nowrap\">e\u207B</span></dd>",
         "<dt>Offset</dt><dd><b>95.00</b> <span class=\"nowrap\">\u00B1&#160;0.50 DN</span></dd>",
         "<th role=\"rowheader\" scope=\"row\" abbr=\"read noise \u03C3\"><span>read noise \u03C3</span><small>",
         "<td role=\"cell\" class=\"number\">4.000</td><td role=\"cell\" class=\"number\">\u00B1&#160;0.050</td>",
         "rolling_shutter",
         "not given by this method",
         "<sub>e.sat</sub>",
         "\u2248 8000 e\u207B" }) // (4095 - 95) / 0.5
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  EXPECT_FALSE(Contains(page, "class=\"date\""));
}

TEST(SensorNoiseReportPage, TheTitleIsTheFileElseTheCamera)
{
  Report report = MakeGoodReport(20);
  report.camera.camera = "Maker <7>";
  EXPECT_TRUE(Contains(ToHtml(report), "<title>Noise of Maker &lt;7&gt;</title>"));
  const std::string page = ToHtml(report, {}, { "a & b.tif", "2026-11-24 23:30 UTC" });
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "<title>Noise of a &amp; b.tif</title>"));
  EXPECT_TRUE(Contains(page, "<h1>Noise of a &amp; b.tif</h1>\n<p class=\"soft\">Maker &lt;7&gt; \u00B7 "));
  EXPECT_TRUE(Contains(page, "file date <time>2026-11-24 23:30 UTC</time>"));
}

TEST(SensorNoiseReportPage, QuantitiesStandInTheirGroups)
{
  const std::string page = ToHtml(MakeGoodReport(20));
  std::size_t       at = 0;
  for (const char * const part : { ">Sensor</th>",
                                   "<span>gain g</span>",
                                   "<span>offset \u03BC</span>",
                                   ">Illumination and motion</th>",
                                   "<span>flicker sd</span>",
                                   "<span>vibration sd x</span>",
                                   ">For a denoiser: variance = slope \u00D7 level + intercept</th>",
                                   "<span>variance slope</span>",
                                   "<span>total intercept</span>" })
  {
    const std::size_t next = page.find(part);
    ASSERT_NE(next, std::string::npos) << part;
    EXPECT_LT(at, next) << part;
    EXPECT_EQ(page.find(part, next + 1), std::string::npos) << part;
    at = next;
  }
}

TEST(SensorNoiseReportPage, AReadNoiseThatIsNotDistinguishedHasItsLimit)
{
  Report report = MakeGoodReport(20);
  for (Quantity * const quantity : { &report.readNoise, &report.readNoiseElectrons })
  {
    *quantity = Quantity::Without(EstimateStatus::UpperLimit);
  }
  report.readNoise.bracket = Interval{ 0.0, 1.58 };
  report.readNoiseElectrons.bracket = Interval{ 0.0, 3.16 };
  EXPECT_TRUE(Contains(ToHtml(report),
                       "<div class=\"key is-warning\"><dt>Read noise</dt><dd><b>&lt; 3.16</b> <span "
                       "class=\"nowrap\">e\u207B</span></dd><dd class=\"soft\">upper limit, limits 0 to 3.16; <span "
                       "class=\"nowrap\">&lt; 1.58 DN</span></dd>"));
}

TEST(SensorNoiseReportPage, AnEmptyReportSaysThatThereIsNothing)
{
  Report report;
  report.Warn(WarningCode::NothingToMeasure, "there are 3 different frames; expected 5");
  const std::string page = ToHtml(report);
  ExpectSound(page);
  EXPECT_FALSE(Contains(page, "<svg"));
  EXPECT_FALSE(Contains(page, "<td>\u2013"));
  EXPECT_FALSE(Contains(page, "<dl"));
  for (const char * const part : { "<span class=\"word\">Not measured</span>: <a href=\"#nothing-to-measure\">",
                                   "There are 3 different frames; expected 5.",
                                   "No point of the noise curve was measured.",
                                   "Neither flicker nor motion was measured." })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  EXPECT_EQ(FaultOfTags(ToSvg(report)), "");
}

TEST(SensorNoiseReportPage, OfAFailedReportTheErrorComesFirst)
{
  Report report = MakeGoodReport(20);
  report.gain = Quantity::Without(EstimateStatus::Failed);
  report.Warn(WarningCode::NotStatic, "many pixels move");
  report.Warn(WarningCode::VarianceNotAffine, "the variance departs from its line");
  const std::string page = ToHtml(report);
  const std::size_t table = page.find("<table");
  const std::size_t note = page.find("Many pixels move.");
  EXPECT_LT(page.find("<span class=\"word\">error</span>"), note);
  EXPECT_LT(note, page.find("Noise curve"));
  EXPECT_LT(note, table);
}

TEST(SensorNoiseReportPage, SaysHowWellItFits)
{
  Report report = MakeGoodReport(20);
  report.fit.reducedChi2 = 0.9876;
  report.fit.nonlinearity = 0.02;
  report.noiseCorrelation->space[0] = { 1, 0, 0, 0.4, 0.01 };
  report.noiseCorrelation->kind = "filtered";
  report.pixels.total = 1000;
  report.pixels.clipped = 125;
  const std::string page = ToHtml(report);
  for (const char * const part : { "Fit: reduced \u03C7\u00B2 0.9876 (1: only sampling noise is left).",
                                   "by up to 2 % of itself.",
                                   "Noise: filtered, correlation of neighbours up to 40 %",
                                   "up to 1.15 times as far.", // sqrt(1 + 2 * 0.16)
                                   "12.5 % clipped" })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  EXPECT_FALSE(Contains(ToHtml(MakeGoodReport(20)), "times as far"));
}

TEST(SensorNoiseReportPage, PartsOfUnlikeGainHaveATable)
{
  Report report = MakeGoodReport(20);
  EXPECT_FALSE(Contains(ToHtml(report), "Gain of the parts"));
  report.gainByParts = { { "halves-x", { { "left half", 0.49, 0.002, 0.5 }, { "right half", 0.51, 0.002, 0.4 } } } };
  const std::string page = ToHtml(report);
  for (const char * const part : { "Gain of the parts", "left half", "halves-x", "0.5100 \u00B1 0.0020", "40 %" })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
}

TEST(SensorNoiseReportPage, OfOneFrameItSaysNothingOfFlickerAndMotion)
{
  Report report = MakeGoodReport(1);
  report.method = "single-image";
  report.singleImage.emplace();
  report.scatter.correctedVariance = report.scatter.variance;
  const std::string page = ToHtml(report);
  for (const std::string words : { "without flicker and motion", "Flicker and motion add", "orange rings", "1 frames" })
  {
    EXPECT_EQ(page.find(words), std::string::npos) << words;
  }
  for (const std::string words : { "1 frame of 6000", "level sets", "Each point is a level set" })
  {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_NE(ToHtml(MakeGoodReport(40)).find("without flicker and motion"), std::string::npos);
}

TEST(SensorNoiseReportPage, WhatIsNotANumberIsNotDrawn)
{
  Report report = MakeGoodReport(50);
  report.scatter.mean[3] = NotANumber;
  report.scatter.variance[4] = std::numeric_limits<double>::infinity();
  report.scatter.variance[8] = NotANumber;
  report.scatter.correctedVariance[5] = NotANumber;
  report.flicker[6] = NotANumber;
  report.motion[7] = { NotANumber, -std::numeric_limits<double>::infinity() };
  report.noiseCorrelation->space.push_back({ 0, 1, 0, NotANumber, NotANumber });
  (*report.covariance)[0][1] = NotANumber;
  report.gain = Quantity::Without(EstimateStatus::Failed);
  ExpectSound(ToHtml(report));
  report.fit.line->gain = NotANumber;
  ExpectSound(ToHtml(report));
  for (auto & flicker : report.flicker)
  {
    flicker = NotANumber;
  }
  report.motion.assign(report.motion.size(), { NotANumber, NotANumber });
  ExpectSound(ToHtml(report));
  EXPECT_TRUE(Contains(ToHtml(report), "Neither flicker nor motion was measured."));
}

TEST(SensorNoiseReportPage, OfManyPixelsAndFramesItStaysSmall)
{
  const Report              report = MakeGoodReport(60000);
  std::vector<double>       mean(report.width * report.height);
  std::vector<std::uint8_t> use(mean.size());
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    const std::size_t mixed = i * 2654435761U % 4096; // a picture that no compression makes small
    mean[i] = static_cast<double>(mixed);
    use[i] = static_cast<std::uint8_t>(mixed % 14);
  }
  const std::string page = ToHtml(report, { report.width, report.height, mean.data(), use.data() });
  EXPECT_LT(page.size(), 1000000U);
  EXPECT_TRUE(Contains(page, "width=\"250\" height=\"167\" src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_TRUE(Contains(page, "near a clip level, 7.1"));
  EXPECT_EQ(FaultOfTags(page), "");
}

TEST(SensorNoiseReportPage, OfAMosaicItHasAllChannels)
{
  std::array<Report, 4> channels;
  channels.fill(MakeGoodReport(30));
  channels[3] = Report();
  channels[3].Warn(WarningCode::IntensityRangeTooSmall, "the blue plane has one level");
  const std::string page = ToHtml(MakeChannelReports(BayerPattern::RGGB, BayerSource::Given, channels));
  ExpectSound(page);
  for (const char * const part : { "Channel R<", "Channel G1", "Channel G2", "Channel B", ">Not measured in B</span>" })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  EXPECT_TRUE(Contains(page, "B: the blue plane has one level."));
  // three curves can be seen without opening anything
  const std::string shown = page.substr(0, page.find("<details>"));
  std::size_t       curves = 0;
  for (std::size_t at = shown.find("<svg viewBox"); at != std::string::npos; at = shown.find("<svg viewBox", at + 1))
  {
    ++curves;
  }
  EXPECT_EQ(curves, 3U);
}

TEST(SensorNoiseReportPage, TheFigureIsAFileOfItsOwn)
{
  const std::string svg = ToSvg(MakeGoodReport(30));
  EXPECT_TRUE(
    Contains(svg, "<title>The gain is 0.5000 \u00B1 0.0010 DN/e\u207B, and the read noise 8 e\u207B.</title>"));
  EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
  EXPECT_EQ(FaultOfTags(svg), "");
  EXPECT_TRUE(Contains(svg, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_FALSE(Contains(svg, "nan"));
}
