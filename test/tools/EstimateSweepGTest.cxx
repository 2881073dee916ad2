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
  /** Expects exit code 2, one sentence with these parts, and no further file. */
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
  /** Returns how often the last run measured a burst. */
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
  WriteText("t.csv", "iso,frames,Darks\n100,x,y\n");
  IsRefusedSweep("--sweep t.csv", { "line 1 of t.csv", "iso and \"Darks\"", "iso, frames and", "no other column" });
  WriteText("t.csv", "exposure,iso,frames\n1,100,x\n");
  IsRefusedSweep("--sweep t.csv", { "line 1 of t.csv", "iso and \"exposure\"", "leave it out" });
  WriteText("t.csv", "iso,frames,frames\n100,x,y\n");
  IsRefusedSweep("--sweep t.csv", { "line 1 of t.csv", "frames twice", "expected each column once" });
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
    dng.greyValues[0] += 1;
    WriteText("shot" + std::to_string(dng.greyValues[0]) + ".dng", dng.Bytes());
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

// The files record 1/50 s, which is the exposure in both names.
TEST_F(EstimateSweepTool, DoesNotMeasureExposuresAtAnotherSpeed)
{
  auto dng = sensornoise::test::DngOf::Sound();
  for (const unsigned iso : { 400U, 800U })
  {
    const std::string folder = iso == 400U ? "cam/20ms" : "cam/exposure20ms";
    dng.iso = iso;
    std::filesystem::create_directories(Path(folder));
    WriteText(folder + "/shot.dng", dng.Bytes());
  }
  EXPECT_EQ(Run("--sweep cam --json p.json"), 3) << m_Message; // one frame each
  EXPECT_TRUE(Says("its files record ISO 800, and the files of 20ms ISO 400; expected exposures at one ISO speed"))
    << m_Output;
  EXPECT_EQ(Passport()["settings"][0]["setting"], 0.02); // LibRaw has 0.01999999955, in single precision
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
  IsRefusedSweep("--sweep cam --json p.json", { "p.json", "no passport", "does not overwrite it: name another file" });
  IsRefusedSweep("--sweep nowhere", { "nowhere does not exist", "a folder for each setting", "a table (.csv)" });
  std::filesystem::create_directory(Path("empty"));
  IsRefusedSweep("--sweep empty", { "empty", "there is no file in this folder" });
  Write("frame.mha", Make<itk::Image<unsigned short, 2>>({ { 8, 8 } }, 5).GetPointer());
  IsRefusedSweep("--sweep frame.mha", { "frame.mha", "no ISO speed", "iso800" });
}
