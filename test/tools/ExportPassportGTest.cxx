// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <string>

namespace
{
/** Runs export-noise-model on the passport of a camera. */
class ExportPassportTool : public EstimateToolTest
{};

/** Returns a passport of three ISO speeds, as the tool writes it: a = 0.005 ISO, an offset of 64 DN, a read noise of 3
 * e-. */
nlohmann::json
MakePassport()
{
  const auto quantity = [](double value) {
    return nlohmann::json{ { "value", value }, { "standard_error", 0.01 * value }, { "status", "identified" } };
  };
  nlohmann::json settings = nlohmann::json::array();
  for (const double iso : { 100.0, 200.0, 800.0 })
  {
    const double         a = 0.005 * iso;
    const nlohmann::json report{ { "schema", "itk-sensornoise-report/1" },
                                 { "channel", "mono" },
                                 { "variance_slope", quantity(a) },
                                 { "total_intercept", quantity(9.0 * a * a - 64.0 * a) },
                                 { "gain", quantity(a) },
                                 { "offset", quantity(64.0) },
                                 { "read_noise", quantity(3.0 * a) },
                                 { "read_noise_electrons", quantity(3.0) },
                                 { "camera", { { "black_level", 64.0 }, { "white_level", 4095.0 } } } };
    settings.push_back({ { "name", "iso" + std::to_string(static_cast<int>(iso)) },
                         { "setting", iso },
                         { "status", "measured" },
                         { "reason", nullptr },
                         { "options", "" },
                         { "report", report } });
  }
  return { { "schema", "itk-sensornoise-passport/1" },
           { "setting", "iso" },
           { "settings", settings },
           { "conversion_gain_switch", nullptr } };
}
} // namespace

// Closed form: between ISO 200 and 800 the camera of the passport is the camera of ISO 400.
TEST_F(ExportPassportTool, ExportsASettingOfThePassport)
{
  WriteText("p.json", MakePassport().dump());
  WriteText("report.json", MakePassport()["settings"][1]["report"].dump());
  ASSERT_EQ(Export("report.json --format dng"), 0) << m_Message;
  const std::string expected = m_Output;
  ASSERT_EQ(Export("p.json --setting 200 --format dng"), 0) << m_Message;
  EXPECT_EQ(m_Output, expected);
  EXPECT_EQ(m_Message, "");
  ASSERT_EQ(Export("p.json --setting 400 --format ndsafir"), 0) << m_Message;
  const auto model = nlohmann::json::parse(m_Output);
  EXPECT_NEAR(model["gains"][0].get<double>(), 2.0, 1e-9) << m_Output;
  EXPECT_NEAR(model["offsets"][0].get<double>(), 36.0 - 128.0, 1e-9);
  EXPECT_TRUE(
    Says("note: The noise is interpolated between the measured settings 200 and 800: gain 2.000 \u00B1 0.014"))
    << m_Message;
  EXPECT_EQ(Export("p.json --format dng"), 3);
  SaysInOneSentence({ "p.json", "100, 200, 800", "--setting" });
  EXPECT_EQ(Export("p.json --format dng --setting 1600"), 3);
  SaysInOneSentence({ "ISO 1600", "outside", "100 to 800" });
  EXPECT_EQ(Export("report.json --format dng --setting 200"), 2);
  SaysInOneSentence({ "--setting", "passport" });
  nlohmann::json passport = MakePassport();
  passport["conversion_gain_switch"] = { { "below", 200 }, { "above", 800 } };
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format dng --setting 400"), 3);
  SaysInOneSentence({ "between 200 and 800", "switches its conversion gain" });
}

// A setting that the camera scales in another way says nothing about the settings beside it.
TEST_F(ExportPassportTool, DoesNotInterpolateBesideASettingThatLeavesTheLine)
{
  nlohmann::json passport = MakePassport();
  const auto     deviation = [](double setting, double value) {
    return nlohmann::json{ { "setting", setting }, { "deviation", value }, { "leaves_line", value != 0.0 } };
  };
  passport["gain_line"] = { { "parts", nlohmann::json::array() },
                            { "deviations", { deviation(100, -0.2), deviation(200, 0.0), deviation(800, 0.0) } } };
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format dng --setting 150"), 3);
  SaysInOneSentence(
    { "ISO 150 is between 100 and 200, and ISO 100 leaves the line of the gains: its gain is 20 % below it",
      "Measure a burst at this setting" });
  EXPECT_EQ(Export("p.json --format dng --setting 100"), 0) << m_Message;
  ASSERT_EQ(Export("p.json --format dng --setting 400"), 0) << m_Message;
  EXPECT_TRUE(Says("gain 2.000 \u00B1 0.014 DN/e\u207B, read noise 6.000 \u00B1 0.042 DN")) << m_Message;
}

TEST_F(ExportPassportTool, SaysWhyABurstOfThePassportHasNoNoise)
{
  nlohmann::json passport = MakePassport();
  for (const double iso : { 400.0, 1600.0 })
  {
    passport["settings"].push_back({ { "name", "x" },
                                     { "setting", iso },
                                     { "reason", "the lamp was off." },
                                     { "options", "" },
                                     { "report", nullptr } });
  }
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format dng --setting 1600"), 3);
  SaysInOneSentence({ "ISO 1600 is outside", "could not be measured: the lamp was off." });
  ASSERT_EQ(Export("p.json --format dng --setting 400"), 0) << m_Message;
  EXPECT_TRUE(Says("interpolated between the measured settings 200 and 800")) << m_Message;
  EXPECT_TRUE(Says("could not be measured: the lamp was off.")) << m_Message;
}

// The gain of the camera is libcamera's analogue gain, unless another one is given.
TEST_F(ExportPassportTool, GainsAreTheAnalogueGainsOfLibcamera)
{
  nlohmann::json passport = MakePassport();
  passport["setting"] = "gain";
  for (nlohmann::json & entry : passport["settings"])
  {
    entry["report"]["bit_depth"] = 12;
    entry["setting"] = entry["setting"].get<double>() / 100.0;
  }
  WriteText("p.json", passport.dump());
  WriteText("report.json", passport["settings"][2]["report"].dump());
  ASSERT_EQ(Export("report.json --format libcamera --analogue-gain 8"), 0) << m_Message;
  const std::string expected = m_Output;
  ASSERT_EQ(Export("p.json --format libcamera --setting 8"), 0) << m_Message;
  EXPECT_EQ(m_Output, expected);
  ASSERT_EQ(Export("report.json --format libcamera --analogue-gain 3"), 0) << m_Message;
  const std::string given = m_Output;
  ASSERT_EQ(Export("p.json --format libcamera --setting 8 --analogue-gain 3"), 0) << m_Message;
  EXPECT_EQ(m_Output, given);
  // A power law: one electron is the same number of libcamera's levels at every gain.
  ASSERT_EQ(Export("p.json --format libcamera --setting 4"), 0) << m_Message;
  EXPECT_NEAR(nlohmann::json::parse(m_Output)["rpi.noise"]["reference_slope"].get<double>(),
              nlohmann::json::parse(expected)["rpi.noise"]["reference_slope"].get<double>(),
              0.2);
}

// Closed form: S = 0.005 ISO / (W - B), and O = (3 x 0.005 ISO)^2 / (W - B)^2, are Android's model.
TEST_F(ExportPassportTool, ExportsAllSettingsForAndroid)
{
  WriteText("p.json", MakePassport().dump());
  ASSERT_EQ(Export("p.json --format android"), 0) << m_Message;
  const auto model = nlohmann::json::parse(m_Output);
  EXPECT_NEAR(model["noise_model_A"][0].get<double>(), 0.005 / 4031.0, 1e-12);
  EXPECT_NEAR(model["noise_model_C"][0].get<double>(), std::pow(0.015 / 4031.0, 2.0), 1e-16);
}

TEST_F(ExportPassportTool, RefusesAPassportThatIsNotWhole)
{
  nlohmann::json passport = MakePassport();
  passport["settings"][1].erase("report");
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format android"), 3);
  SaysInOneSentence({ "p.json", "no report", "whole passport" });
  passport = MakePassport();
  passport["settings"][1]["setting"] = nullptr;
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format android"), 3);
  SaysInOneSentence({ "p.json", "without its setting", "iso200" });
  passport.erase("settings");
  WriteText("p.json", passport.dump());
  EXPECT_EQ(Export("p.json --format android"), 3);
  SaysInOneSentence({ "p.json", "no settings" });
}
