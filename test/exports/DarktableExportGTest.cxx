// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"
#include "helpers/ProfileTestHelper.h"

#include <string>
#include <vector>

using namespace sensornoise;

/** Presets of darktable: variance of the Haar details of demosaiced images = a x + b, with x from 0 at black to 1 at
 * white. */
class DarktableExport : public ProfileTest
{
protected:
  void
  SetUp() override
  {
    ProfileTest::SetUp();
    m_Report.numbers["/camera/iso_speed"] = 200.0;
    m_Report.texts["/camera/name"] = "Maker Camera 5";
  }
  /** Returns the variance [DN^2] of the mosaic by the numbers of one channel. */
  static double
  VarianceOf(const std::string & text, std::size_t channel, const DarktableFactor & factor, double level)
  {
    const double x = (level - black) / (white - black);
    return (NumberIn(text, "\"a\": [", channel) * x + NumberIn(text, "\"b\": [", channel)) / factor.value *
           (white - black) * (white - black);
  }
  static double
  NumberIn(const std::string & text, const std::string & list, std::size_t place)
  {
    std::size_t at = text.find(list) + list.size();
    for (; place > 0; --place)
    {
      at = text.find(", ", at) + 2;
    }
    return std::strtod(text.c_str() + at, nullptr);
  }
  /** Returns the values of presets of ISO 100 and 400 with the noise of the report at their middle on a line, ISO 200.
   */
  static StoredReport
  PresetsAround(double factor)
  {
    const double range = white - black;
    StoredReport values;
    values.name = "noiseprofiles.json";
    values.texts["/noiseprofiles/0/maker"] = "Maker";
    values.texts["/noiseprofiles/0/models/0/model"] = "Camera 5";
    values.numbers["/version"] = 0.0;
    for (int i = 0; i < 2; ++i)
    {
      const std::string at = "/noiseprofiles/0/models/0/profiles/" + std::to_string(i);
      const double      scale = i == 0 ? 0.5 : 2.0; // 2/3 of one and 1/3 of the other are 1
      values.numbers[at + "/iso"] = i == 0 ? 100.0 : 400.0;
      values.numbers[at + "/a/1"] = factor * scale * slope / range;
      values.numbers[at + "/b/1"] = factor * scale * (intercept + slope * black) / (range * range);
    }
    return values;
  }
  static void
  IsRefusedAs(const StoredReport & values, const std::string & part)
  {
    try
    {
      ReadNoiseProfile(values);
      ADD_FAILURE() << part;
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
};

TEST_F(DarktableExport, NumbersAreTheLineTimesTheFactors)
{
  this->MakeMosaic();
  const auto        made = this->Export("darktable");
  const std::string text = made.files.at(0).bytes;
  IsTheLine(
    [&](double level) { return VarianceOf(text, 0, darktableRedBlue, level); }, MosaicSlope(0), MosaicIntercept(0));
  IsTheLine([&](double level) { return VarianceOf(text, 1, darktableGreen, level); },
            0.5 * (MosaicSlope(1) + MosaicSlope(2)),
            0.5 * (MosaicIntercept(1) + MosaicIntercept(2)));
  IsTheLine(
    [&](double level) { return VarianceOf(text, 2, darktableRedBlue, level); }, MosaicSlope(3), MosaicIntercept(3));
  EXPECT_NE(
    text.find("{\"version\": 0, \"noiseprofiles\": [{\"maker\": \"Maker\", \"models\": [{\"model\": \"Camera 5\", "
              "\"profiles\": [{\"name\": \"Camera 5 iso 200\", \"iso\": 200, \"a\": ["),
    std::string::npos)
    << text;
  EXPECT_NE(made.note.find("Compare maker and model"), std::string::npos) << made.note;
}

TEST_F(DarktableExport, DetailsOfWhiteNoiseHaveAQuarterOfTheVariance)
{
  m_Report.texts.erase("/camera/name");
  const auto made = this->Export("darktable");
  for (const std::size_t channel : { 0, 1, 2 })
  {
    IsTheLine([&](double level) { return VarianceOf(made.files.at(0).bytes, channel, { 0.25, 0.0 }, level); });
  }
  EXPECT_NE(made.note.find("Replace maker and model"), std::string::npos) << made.note;
}

TEST_F(DarktableExport, SpeedsRiseAndDiffer)
{
  const CameraNoise second = ReadCameraNoise(m_Report);
  m_Report.numbers["/camera/iso_speed"] = 100.0;
  const CameraNoise first = ReadCameraNoise(m_Report);
  const std::string text = ExportNoise("darktable", { second, first }).files.at(0).bytes;
  EXPECT_LT(text.find("iso 100"), text.find("iso 200"));
  EXPECT_THROW(ExportNoise("darktable", { first, first }), ExportError);
  m_Report.numbers.erase("/camera/iso_speed");
  IsRefused("darktable", { "no ISO speed", "darktable" });
}

TEST_F(DarktableExport, PresetsAreInterpolatedAndCheckedByGreen)
{
  m_Report.texts["/channel"] = "R"; // darktable takes the numbers of green for all channels
  IsTrue(ReadNoiseProfile(PresetsAround(darktableGreen.value)));
  m_Report.texts["/channel"] = "mono";
  IsTrue(ReadNoiseProfile(PresetsAround(0.25)));
  EXPECT_EQ(Check(ReadNoiseProfile(PresetsAround(0.5))).verdict, NoiseModelCheck::Verdict::DoesNotFit);
}

TEST_F(DarktableExport, PresetsOfAnotherDemosaicingAreNamed)
{
  m_Report.texts["/channel"] = "G1";
  const auto check = Check(ReadNoiseProfile(PresetsAround(darktableGreenPpg)));
  EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::DoesNotFit);
  EXPECT_NE(check.sentence.find("with the demosaicing PPG"), std::string::npos) << check.sentence;
}

TEST_F(DarktableExport, PresetsOfAnotherCameraOrSpeedAreRefused)
{
  StoredReport values = PresetsAround(0.25);
  m_Report.texts["/camera/name"] = "Another";
  IsTrue(ReadNoiseProfile(values)); // the file has one camera, whose name may differ
  values.texts["/noiseprofiles/0/models/1/model"] = "Camera 6";
  for (const char * number : { "/iso", "/a/1", "/b/1" })
  {
    values.numbers[std::string("/noiseprofiles/0/models/1/profiles/0") + number] = 100.0;
  }
  EXPECT_THROW(Check(ReadNoiseProfile(values)), ExportError);
  m_Report.texts["/camera/name"] = "MAKER camera 5";
  IsTrue(ReadNoiseProfile(values));
  for (const double iso : { 50.0, 401.0 })
  {
    m_Report.numbers["/camera/iso_speed"] = iso;
    EXPECT_THROW(Check(ReadNoiseProfile(values)), ExportError) << iso;
  }
  m_Report.numbers.erase("/camera/iso_speed");
  EXPECT_THROW(Check(ReadNoiseProfile(values)), ExportError);
  values.numbers.erase("/noiseprofiles/0/models/0/profiles/1/a/1");
  IsRefusedAs(values, "no number /noiseprofiles/0/models/0/profiles/1/a/1");
  IsRefusedAs(
    [] {
      StoredReport empty;
      empty.numbers = { { "/version", 0.0 }, { "/noiseprofiles/0/iso", 1.0 } };
      return empty;
    }(),
    "no preset");
}
