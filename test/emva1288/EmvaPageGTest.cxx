// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"
#include "helpers/EmvaTestHelper.h"
#include "helpers/PageTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::emva;

namespace
{
constexpr int FlatExposures = 20;
constexpr int InFit = 14; // up to 70 % of 20 equal steps

/** Returns the evaluation of an exact camera: 20 exposures up to 7000 electrons and a saturated one, and dark frames.
 */
EmvaReport
ReportOf(double gain, bool hasPhotons = true)
{
  LinearCamera camera;
  camera.gain = gain;
  std::vector<EmvaSeries> series{ ExactSeries(camera, 0.0, 0.0) };
  for (int i = 1; i <= FlatExposures; ++i)
  {
    series.push_back(ExactSeries(camera, i, 350.0 * i));
  }
  series.push_back(SaturatedSeries(camera, 21.0, 7350.0));
  if (!hasPhotons)
  {
    std::for_each(series.begin(), series.end(), [](EmvaSeries & each) { each.photons.reset(); });
  }
  return EvaluateEmva1288(series, { 1.0, 12, "s" });
}
} // namespace

TEST(SensorNoiseEmvaPage, HasTheResultsOfTheStandard)
{
  const std::string page = ToHtml(ReportOf(0.5), { "a & b.csv", "2026-11-24" });
  ExpectSound(page);
  for (const char * const part : { "<title>EMVA 1288: a &amp; b.csv</title>",
                                   "Release 4.0 Linear",
                                   "<dt>System gain K</dt><dd><b>0.5000",
                                   "<dt>Saturation capacity</dt><dd><b>7000",
                                   "<small>K, equation (50)</small>",
                                   "<small>\u03BC<sub>p.min</sub>, equation (26)</small>",
                                   "DN/photon",
                                   "Non-uniformity, after the highpass filter",
                                   "\u03BC_y \u2212 \u03BC_y.dark",
                                   ">photons</text>",
                                   "21 flat exposures",
                                   "<code>few-exposures</code>",
                                   "The standard asks for 50." })
  {
    EXPECT_TRUE(Contains(page, part)) << part;
  }
  // all quantities have a row, all exposures have one
  EXPECT_EQ(CountOf(page, "abbr="), EmvaQuantityList().size());
  EXPECT_EQ(CountOf(page, "<td>yes</td>"), static_cast<std::size_t>(InFit));
  EXPECT_EQ(CountOf(page, "<td>no</td>"), static_cast<std::size_t>(FlatExposures + 1 - InFit));
}

TEST(SensorNoiseEmvaPage, HasTheHashOfTheFrames)
{
  InputRecord input;
  input.frames.files = 24;
  input.frames.bytes = 4096;
  input.frames.sha256 = std::string(64, 'a');
  EXPECT_FALSE(Contains(ToHtml(ReportOf(0.5)), "SHA-256"));
  const std::string page = ToHtml(ReportOf(0.5), {}, input);
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "24 files, 4096 bytes"));
  EXPECT_TRUE(Contains(page, "<code>" + input.frames.sha256 + "</code>"));
  EXPECT_FALSE(Contains(page, "dark frames<small>"));
  input.dark = input.frames;
  input.dark->sha256 = std::string(64, 'b');
  EmvaMosaicReport mosaic;
  mosaic.planes.fill(ReportOf(0.5));
  const std::string ofMosaic = ToHtml(mosaic, {}, input);
  ExpectSound(ofMosaic);
  EXPECT_EQ(CountOf(ofMosaic, input.frames.sha256), 1U);
  EXPECT_EQ(CountOf(ofMosaic, input.dark->sha256), 1U);
}

TEST(SensorNoiseEmvaPage, WithoutPhotonsTheAxesAreExposureAndElectrons)
{
  const std::string page = ToHtml(ReportOf(0.5, false));
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "exposure [s]"));
  EXPECT_TRUE(Contains(page, "signal [e\u207B]"));
  EXPECT_FALSE(Contains(page, ">photons</text>"));
  EXPECT_TRUE(Contains(page, "<title>EMVA 1288</title>"));
}

TEST(SensorNoiseEmvaPage, WithoutAGainThePageSaysSo)
{
  const LinearCamera            camera;
  const std::vector<EmvaSeries> series{ ExactSeries(camera, 0.0, 0.0),
                                        ExactSeries(camera, 1.0, 6000.0),
                                        ExactSeries(camera, 1.1, 6500.0),
                                        ExactSeries(camera, 1.2, 7000.0) };
  const EmvaReport              report = EvaluateEmva1288(series);
  ASSERT_FALSE(report.gain.value);
  const std::string page = ToHtml(report);
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "<code>no-gain</code>"));
  EXPECT_TRUE(Contains(ToSvg(report), "<title>no system gain is identifiable</title>"));
}

TEST(SensorNoiseEmvaPage, TheFigureHasAMarkerForEachExposure)
{
  const std::string svg = ToSvg(ReportOf(0.5));
  EXPECT_EQ(FaultOfTags(svg), "");
  EXPECT_TRUE(Contains(svg, "<title>system gain K = 0.5000"));
  // one path has all markers of a kind, one "M" each
  const auto markers = [&svg](const std::string & style) {
    const std::size_t begin = svg.rfind("<path class=\"" + style);
    return CountOf(svg.substr(begin, svg.find("/>", begin) - begin), "M");
  };
  EXPECT_EQ(markers("after point"), static_cast<std::size_t>(InFit));
  EXPECT_EQ(markers("before point"), static_cast<std::size_t>(FlatExposures + 1 - InFit));
}

TEST(SensorNoiseEmvaPage, AMosaicHasItsPlanes)
{
  EmvaMosaicReport mosaic;
  mosaic.pattern = BayerPattern::GBRG;
  mosaic.planes = { ReportOf(0.5), ReportOf(0.6), ReportOf(0.7), ReportOf(0.8) };
  const std::string page = ToHtml(mosaic);
  ExpectSound(page);
  EXPECT_TRUE(Contains(page, "Bayer mosaic GBRG"));
  EXPECT_TRUE(Contains(page, "<td>G2</td><td>0.7000"));
  const auto json = nlohmann::json::parse(ToJson(mosaic));
  EXPECT_EQ(json["schema"], EmvaMosaicSchema);
  EXPECT_EQ(json["bayer"], "GBRG");
  EXPECT_EQ(json["planes"]["B"], nlohmann::json::parse(ToJson(mosaic.planes[3])));
  EXPECT_EQ(json["planes"].size(), 4U);
  EXPECT_EQ(FaultOfTags(ToXml(mosaic)), "");
  EXPECT_TRUE(Contains(ToXml(mosaic), "<plane name=\"G1\">\n" + ToXml(mosaic.planes[1]) + "</plane>"));
  EXPECT_TRUE(Contains(MakeTable(mosaic), "Plane G2\n" + MakeTable(mosaic.planes[2])));
  EXPECT_EQ(ToSvg(mosaic), ToSvg(mosaic.planes[1]));
}
