// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/DngTestHelper.h"
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace
{
/** --sweep: a camera at all its settings. */
class EstimateSweepTool : public EstimateToolTest
{
protected:
  /** Writes light.mha, and dark/dark.mha, into a folder: a camera of \a gain, whose read noise is 3 electrons. */
  void
  MakeSetting(const std::string & folder, double gain, unsigned seed, unsigned frames = 24)
  {
    std::filesystem::create_directories(Path(folder) / "dark");
    const std::string camera = "\"" + ToolFolder() + "/simulate-sensor-noise\" --size 64x64 --offset 100 --gain " +
                               std::to_string(gain) + " --read-noise " + std::to_string(3.0 * gain) + " --frames " +
                               std::to_string(frames) + " --seed " + std::to_string(seed);
    ASSERT_EQ(RunCommand(camera + " --electrons " + std::to_string(3000.0 / gain) + " --flicker-sd 0.05 --output \"" +
                         folder + "/light.mha\""),
              0)
      << m_Message;
    ASSERT_EQ(RunCommand(camera + " --dark --output \"" + folder + "/dark/dark.mha\""), 0) << m_Message;
  }
  /** Makes iso100, iso200 and iso400 in the folder cam: g = 0.005 ISO. */
  void
  MakeCamera()
  {
    MakeSetting("cam/iso100", 0.5, 1);
    MakeSetting("cam/iso200", 1.0, 2);
    MakeSetting("cam/iso400", 2.0, 3);
  }
  nlohmann::json
  Passport(const std::string & name = "p.json") const
  {
    return nlohmann::json::parse(ReadText(Path(name)), nullptr, false);
  }
  int
  Export(const std::string & arguments)
  {
    return RunCommand("\"" + ToolFolder() + "/export-noise-model\" " + arguments);
  }
  /** Exit code 2, one sentence with these parts, and no file more. */
  void
  IsRefusedSweep(const std::string & arguments, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(arguments);
    const std::set<std::string> before = FilesLeft();
    EXPECT_EQ(Run(arguments), 2) << m_Output;
    SaysInOneSentence(parts);
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), before);
  }
  bool
  Says(const std::string & part) const
  {
    return (m_Output + m_Message).find(part) != std::string::npos;
  }
  /** How often the last run measured a burst. */
  int
  Measured() const
  {
    int count = 0;
    for (std::size_t at = m_Message.find(": is measured"); at != std::string::npos;
         at = m_Message.find(": is measured", at + 1))
    {
      ++count;
    }
    return count;
  }
};

/** A passport of three ISO speeds, as the tool writes it: a = 0.005 ISO, an offset of 64 DN, a read noise of 3 e-. */
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

// Identity: each report of the passport is the report of its burst, measured by itself.
TEST_F(EstimateSweepTool, MeasuresEachSettingAsByItself)
{
  MakeCamera();
  ASSERT_EQ(Run("--sweep cam --json p.json --plot p.html"), 0) << m_Message;
  EXPECT_TRUE(Says("3 of 3 settings measured"));
  EXPECT_TRUE(Says("The gain is (0.00"));
  EXPECT_NE(ReadText(Path("p.html")).find("<figure>"), std::string::npos);
  const nlohmann::json passport = Passport();
  ASSERT_EQ(passport["settings"].size(), 3U);
  EXPECT_EQ(passport["setting"], "iso");
  for (const nlohmann::json & entry : passport["settings"])
  {
    const std::string    folder = "cam/" + entry["name"].get<std::string>();
    const nlohmann::json report = ReportOf(folder + " --dark " + folder + "/dark --hash");
    EXPECT_EQ(entry["report"], report) << folder;
    const double gain = 0.005 * entry["setting"].get<double>();
    const auto & measured = entry["channels"][0]["gain"];
    EXPECT_NEAR(
      measured["value"].get<double>(), gain, std::max(0.01 * gain, 3.0 * measured["standard_error"].get<double>()));
    EXPECT_EQ(measured["value"], report["gain"]["value"]);
  }
  EXPECT_EQ(passport["gain_line"]["parts"][0]["settings"], 3);
}

// The bursts have one gain: at all exposures, or with another one at the last.
TEST_F(EstimateSweepTool, TestsTheGainsOfExposures)
{
  MakeSetting("cam/10ms", 0.5, 1);
  MakeSetting("cam/20ms", 0.5, 2);
  MakeSetting("cam/exposure0.04s", 0.5, 3);
  ASSERT_EQ(Run("--sweep cam --json p.json --plot p.html"), 0) << m_Message;
  EXPECT_TRUE(Says("The gain is the same at all 3 exposures: (0.")) << m_Output;
  const nlohmann::json passport = Passport();
  EXPECT_EQ(passport["setting"], "exposure");
  EXPECT_EQ(passport["gain_line"]["parts"].size(), 0U);
  EXPECT_EQ(passport["settings"][2]["setting"], 0.04);
  const nlohmann::json & common = passport["common_gain"][0];
  EXPECT_EQ(common["is_same"], true);
  EXPECT_NEAR(common["gain"]["value"].get<double>(), 0.5, 3.0 * common["gain"]["standard_error"].get<double>());
  EXPECT_EQ(Export("p.json --format fits --setting 0.02"), 0) << m_Message;
  EXPECT_EQ(Export("p.json --format fits --setting 0.03"), 3);
  EXPECT_TRUE(Says("nothing is interpolated between exposures")) << m_Message;

  WriteText("t.csv",
            "exposure_ms,frames,dark\n10,cam/10ms,cam/10ms/dark\n20,cam/20ms,cam/20ms/dark\n"
            "30,iso100,iso100/dark\n");
  MakeSetting("iso100", 1.0, 4);
  ASSERT_EQ(Run("--sweep t.csv --json q.json"), 0) << m_Message;
  EXPECT_TRUE(Says("Warning: the gain is not the same at all exposures: at exposure 0.03 s it is (")) << m_Output;
  EXPECT_EQ(Passport("q.json")["common_gain"][0]["is_same"], false);
}

#ifdef SENSORNOISE_OPENSSL
TEST_F(EstimateSweepTool, MeasuresAgainOnlyWhatChanged)
{
  MakeCamera();
  ASSERT_EQ(Run("--sweep cam --json p.json"), 0) << m_Message;
  EXPECT_EQ(Measured(), 3);
  const std::string first = ReadText(Path("p.json"));
  ASSERT_EQ(Run("--sweep cam --json p.json --threads 1"), 0) << m_Message;
  EXPECT_EQ(Measured(), 0) << m_Message;
  EXPECT_EQ(ReadText(Path("p.json")), first);
  MakeSetting("cam/iso200", 1.0, 9);
  ASSERT_EQ(Run("--sweep cam --json p.json"), 0) << m_Message;
  EXPECT_EQ(Measured(), 1) << m_Message;
  EXPECT_TRUE(Says("iso200: is measured"));
  EXPECT_NE(Passport()["settings"][1]["report"], nlohmann::json::parse(first)["settings"][1]["report"]);
  std::filesystem::remove_all(Path("cam/iso100/dark"));
  ASSERT_EQ(Run("--sweep cam --json p.json"), 0) << m_Message;
  EXPECT_EQ(Measured(), 1) << m_Message;
  ASSERT_EQ(Run("--sweep cam --json p.json --frames 0:20"), 0) << m_Message;
  EXPECT_EQ(Measured(), 3) << m_Message;
  EXPECT_EQ(Passport()["settings"][0]["options"], "--frames 0:20");
}
#endif

TEST_F(EstimateSweepTool, GivesABadBurstARowWithItsReason)
{
  MakeSetting("cam/iso100", 0.5, 1);
  MakeSetting("cam/iso200", 1.0, 2);
  std::filesystem::remove(Path("cam/iso200/light.mha"));
  MakeSetting("cam/iso400", 2.0, 3);
  std::filesystem::resize_file(Path("cam/iso400/light.mha"), 5000);
  MakeSetting("cam/night", 2.0, 4);
  std::filesystem::create_directories(Path("cam/ISO_100_again"));
  std::filesystem::copy(Path("cam/iso100/light.mha"), Path("cam/ISO_100_again/light.mha"));
  EXPECT_EQ(Run("--sweep cam --json p.json"), 4) << m_Message;
  EXPECT_TRUE(Says("1 of 5 settings measured")) << m_Output;
  EXPECT_TRUE(Says("ISO 200 (iso200): cam/iso200: there is no file in this folder")) << m_Output;
  EXPECT_TRUE(Says("light.mha: truncated")) << m_Output;
  EXPECT_TRUE(Says("night: its setting is not known")) << m_Output;
  EXPECT_TRUE(Says("ISO_100_again has the same setting and is measured")) << m_Output;
  const nlohmann::json entry = Passport()["settings"][2];
  EXPECT_EQ(entry["status"], "failed");
  EXPECT_TRUE(entry["report"].is_null());
  std::filesystem::remove_all(Path("cam/iso100"));
  std::filesystem::remove_all(Path("cam/ISO_100_again"));
  EXPECT_EQ(Run("--sweep cam --json p.json --quiet"), 3) << m_Message;
  EXPECT_EQ(m_Output + m_Message, "");
}

TEST_F(EstimateSweepTool, ReadsATableOfGains)
{
  MakeSetting("bursts/low", 0.5, 1);
  MakeSetting("bursts/high", 1.0, 2);
  WriteText("bursts/t.csv",
            "\xEF\xBB\xBF# a camera\nGain_dB; frames; dark\n6.0206; high/*.mha; high/dark\n\n0; low; low/dark\n");
  ASSERT_EQ(Run("--sweep bursts/t.csv --json p.json"), 0) << m_Message;
  const nlohmann::json passport = Passport();
  EXPECT_EQ(passport["setting"], "gain");
  EXPECT_EQ(passport["settings"][0]["setting"], 1.0);
  EXPECT_NEAR(passport["settings"][1]["setting"].get<double>(), 2.0, 1e-5);
  EXPECT_NEAR(passport["gain_line"]["parts"][0]["scale"]["value"].get<double>(), 0.5, 0.01);
  EXPECT_EQ(passport["settings"][1]["report"]["input"]["dark"]["files"], 1);
  WriteText("t.csv", "iso,frames\n100,bursts/low\nmany,bursts/high\n");
  IsRefusedSweep("--sweep t.csv", { "line 3 of t.csv", "\"many\"", "above 0" });
  WriteText("t.csv", "iso,frames\n100\n");
  IsRefusedSweep("--sweep t.csv", { "line 2 of t.csv", "1 columns", "expected 2" });
  WriteText("t.csv", "speed,frames\n100,x\n");
  IsRefusedSweep("--sweep t.csv", { "line 1 of t.csv", "iso, gain, gain_db, exposure or exposure_ms" });
  WriteText("t.csv", "iso,frames\n");
  IsRefusedSweep("--sweep t.csv", { "t.csv", "no line with a setting" });
  IsRefusedSweep("--sweep none.csv", { "none.csv", "cannot be read" });
}

TEST_F(EstimateSweepTool, GroupsFramesByTheSpeedThatTheyRecord)
{
  auto dng = sensornoise::test::DngOf::Sound();
  for (const unsigned iso : { 400U, 800U, 400U, 400U })
  {
    dng.iso = iso;
    dng.codes[0] += 1;
    WriteText("shot" + std::to_string(dng.codes[0]) + ".dng", dng.Bytes());
  }
  EXPECT_EQ(Run("--sweep . --json p.json --quiet"), 3) << m_Message; // frames without noise
  const nlohmann::json passport = Passport();
  ASSERT_EQ(passport["settings"].size(), 2U) << passport;
  EXPECT_EQ(passport["settings"][0]["name"], "ISO 400");
  EXPECT_EQ(passport["settings"][1]["setting"], 800.0);
  // a folder of the wrong name, and one with both speeds
  std::filesystem::create_directories(Path("cam/iso100"));
  std::filesystem::copy(Path("shot301.dng"), Path("cam/iso100/shot301.dng"));
  std::filesystem::create_directories(Path("cam/shots"));
  std::filesystem::copy(Path("shot302.dng"), Path("cam/shots/shot302.dng"));
  std::filesystem::copy(Path("shot303.dng"), Path("cam/shots/shot303.dng"));
  EXPECT_EQ(Run("--sweep cam"), 3) << m_Message;
  EXPECT_TRUE(Says("its files record ISO 400, but ISO 100 was given")) << m_Output;
  EXPECT_TRUE(Says("the frames record different ISO speeds, 800")) << m_Output;
}

TEST_F(EstimateSweepTool, TakesStacksByTheirNames)
{
  MakeSetting("a", 0.5, 1);
  MakeSetting("b", 1.0, 2);
  std::filesystem::rename(Path("a/light.mha"), Path("gain1.mha"));
  std::filesystem::rename(Path("b/light.mha"), Path("cam_gain2.0_5ms.mha"));
  const nlohmann::json passport = ReportOf("--sweep gain1.mha cam_gain2.0_5ms.mha");
  EXPECT_EQ(passport["settings"][1]["setting"], 2.0);
  EXPECT_NEAR(passport["gain_line"]["parts"][0]["scale"]["value"].get<double>(), 0.5, 0.01);
  std::filesystem::rename(Path("gain1.mha"), Path("iso100.mha"));
  IsRefusedSweep("--sweep iso100.mha cam_gain2.0_5ms.mha", { "is gain 2", "is ISO 100", "one kind" });
}

TEST_F(EstimateSweepTool, RefusesWhatMakesNoSense)
{
  MakeSetting("cam/iso100", 0.5, 1, 3);
  IsRefusedSweep("--sweep cam --dark cam/iso100/dark", { "--dark", "folder dark" });
  IsRefusedSweep("--sweep cam --exposures 1,2", { "--sweep", "--exposures" });
  IsRefusedSweep("--sweep cam --maps m", { "--sweep", "--maps" });
  IsRefusedSweep("--sweep cam --method published", { "published", "--method refined" });
  IsRefusedSweep("--sweep cam --plot p.svg", { "p.svg", "sweep.html" });
  IsRefusedSweep("cam/iso100/light.mha --sweep cam", { "takes the place of FRAME" });
  IsRefusedSweep("--sweep cam --json cam/iso100/light.mha", { "light.mha", "--json" });
  IsRefusedSweep("--sweep cam --plot cam/iso100/dark/dark.html --json cam/iso100/dark/dark.html", { "same file" });
  WriteText("p.json", "{\"schema\": \"other\"}");
  IsRefusedSweep("--sweep cam --json p.json", { "p.json", "no passport" });
  std::filesystem::create_directory(Path("empty"));
  IsRefusedSweep("--sweep empty", { "empty", "there is no file in this folder" });
  Write("frame.mha", Make<itk::Image<unsigned short, 2>>({ { 8, 8 } }, 5).GetPointer());
  IsRefusedSweep("--sweep frame.mha", { "frame.mha", "no ISO speed", "iso800" });
}

// Closed form: between ISO 200 and 800 the camera of the passport is that of ISO 400.
TEST_F(EstimateSweepTool, ExportsASettingOfThePassport)
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
  EXPECT_TRUE(Says("note: The noise is interpolated between the measured settings 200 and 800: gain 2.000 +- 0.014"))
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
TEST_F(EstimateSweepTool, DoesNotInterpolateBesideASettingThatLeavesTheLine)
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
  EXPECT_TRUE(Says("gain 2.000 +- 0.014 DN/e-, read noise 6.000 +- 0.042 DN")) << m_Message;
}

TEST_F(EstimateSweepTool, SaysWhyABurstOfThePassportHasNoNoise)
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
TEST_F(EstimateSweepTool, GainsAreTheAnalogueGainsOfLibcamera)
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
TEST_F(EstimateSweepTool, ExportsAllSettingsForAndroid)
{
  WriteText("p.json", MakePassport().dump());
  ASSERT_EQ(Export("p.json --format android"), 0) << m_Message;
  const auto model = nlohmann::json::parse(m_Output);
  EXPECT_NEAR(model["noise_model_A"][0].get<double>(), 0.005 / 4031.0, 1e-12);
  EXPECT_NEAR(model["noise_model_C"][0].get<double>(), std::pow(0.015 / 4031.0, 2.0), 1e-16);
}

TEST_F(EstimateSweepTool, RefusesAPassportThatIsNotWhole)
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
