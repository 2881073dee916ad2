// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/DngTestHelper.h"
#include "helpers/EstimateToolTestHelper.h"

#include <string>
#include <vector>

namespace
{
/** --check-profile, with profiles that export-noise-model writes. */
class EstimateProfileTool : public EstimateToolTest
{
protected:
  /** Simulates a burst of a camera of 0.3 DN/e-, and measures it with dark frames: report.json. */
  std::string
  Burst()
  {
    const std::string simulate = "\"" + ToolFolder() + "/simulate-sensor-noise\" --gain 0.3 --read-noise 3 --output ";
    EXPECT_EQ(RunCommand(simulate + "burst.mha --seed 5 --reference texture --size 128x96 --frames 40"), 0)
      << m_Message;
    EXPECT_EQ(RunCommand(simulate + "dark.mha --seed 6 --dark --size 128x96 --frames 40"), 0) << m_Message;
    EXPECT_EQ(Run("burst.mha --dark dark.mha --json report.json --quiet"), 0) << m_Message;
    return "burst.mha";
  }
  std::string
  ProfileIn(const std::string & format)
  {
    EXPECT_EQ(Export("report.json --black 100 --white 4095 --output " + format + ".profile --format " + format), 0)
      << m_Message;
    return format + ".profile";
  }
  /** Writes the exported file with another number behind \a key. */
  std::string
  Changed(const std::string & format, const std::string & key, double number)
  {
    std::string       text = ReadText(Path(ProfileIn(format)));
    const std::size_t begin = text.find(key) + key.size();
    text.replace(begin, text.find_first_of(",]}<\n ", begin + 1) - begin, ' ' + std::to_string(number));
    return WriteText("changed.profile", text);
  }
  nlohmann::json
  Check(const std::string & file, const std::string & options = "--dark dark.mha --black 100 --white 4095")
  {
    return ReportOf("burst.mha " + options + " --check-profile " + file)["profile_check"];
  }
  void
  Names(const std::string & file, const std::string & words)
  {
    const auto check = Check(file);
    EXPECT_EQ(check["verdict"], "does-not-fit") << check;
    EXPECT_NE(check["sentence"].get<std::string>().find(" DN: " + words), std::string::npos) << check["sentence"];
  }
};
} // namespace

TEST_F(EstimateProfileTool, EveryExportThatDeterminesTheVarianceAgreesWithItsBurst)
{
  Burst();
  for (const char * format : { "dng",
                               "ndsafir",
                               "anscombe-transform",
                               "deepinv",
                               "careamics",
                               "pyme",
                               "picasso",
                               "smap",
                               "decode",
                               "thunderstorm",
                               "fits",
                               "ccdproc",
                               "lsst",
                               "emva1288",
                               "libcamera" })
  {
    const auto check = Check(ProfileIn(format));
    EXPECT_EQ(check["schema"], "itk-sensornoise-check/1") << format;
    EXPECT_EQ(check["verdict"], "fits") << format << ": " << check;
  }
  EXPECT_EQ(Check("report.json", "--dark dark.mha")["verdict"], "fits");
}

TEST_F(EstimateProfileTool, KnownMistakesOfExportedFilesAreNamed)
{
  Burst();
  const char * const exchanged = "e-/ADU and ADU/e- are exchanged";
  Names(Changed("pyme", "ElectronsPerCount:", 0.3), exchanged);
  Names(Changed("picasso", "Sensitivity:", 0.3), exchanged);
  Names(Changed("smap", "\"conversion\":", 0.3), exchanged);
  Names(Changed("decode", "e_per_adu:", 0.3), exchanged);
  Names(Changed("ccdproc", "\"gain\": {\"value\":", 0.3), exchanged);
  Names(Changed("lsst", "\"gain\": {\"mono\":", 0.3), exchanged);
  Names(Changed("emva1288", "<Symbol>K</Symbol>\n      <Unit>DN/e^-</Unit>\n      <Value>", 1.0 / 0.3), exchanged);
  Names(Changed("smap", "\"offset\":", 0.0), "the black level of 100 DN is not subtracted");
  Names(Changed("pyme", "ADOffset:", 0.0), "the black level of 100 DN is not subtracted");
  Names(Changed("smap", "\"conversion\":", 2.0 / 0.3), "its gain is 2 times too low");
  Names(Changed("ccdproc", "\"readnoise\": {\"value\":", 3.0), "the read noise is in DN in place of e-");
}

TEST_F(EstimateProfileTool, TableEndsWithTheSentence)
{
  Burst();
  EXPECT_EQ(Run("burst.mha --check-profile " + Changed("smap", "\"conversion\":", 0.3)), 0) << m_Message;
  EXPECT_NE(m_Output.find("\nprofile:\nlevel [DN]"), std::string::npos) << m_Output;
  EXPECT_NE(m_Output.find("are exchanged"), std::string::npos) << m_Output;
  EXPECT_EQ(m_Output.find("transform"), std::string::npos) << m_Output; // only the check of a model has it
}

TEST_F(EstimateProfileTool, ChannelsOfAMosaicAreCheckedOneByOne)
{
  EXPECT_EQ(RunCommand("\"" + ToolFolder() +
                       "/simulate-sensor-noise\" --bayer RGGB --output burst.mha --seed 7 "
                       "--reference texture --size 256x192 --frames 40"),
            0)
    << m_Message;
  EXPECT_EQ(Run("burst.mha --bayer RGGB --json report.json --quiet"), 0) << m_Message;
  const auto report = ReportOf("burst.mha --bayer RGGB --check-profile " + ProfileIn("ndsafir"));
  ASSERT_EQ(report["profile_checks"].size(), 4U);
  std::string channels;
  for (const auto & check : report["profile_checks"])
  {
    EXPECT_EQ(check["verdict"], "fits") << check;
    channels += check["channel"].get<std::string>() + ' ';
  }
  EXPECT_EQ(channels, "R G1 G2 B ");
  ReportOf("burst.mha --bayer RGGB --check-profile " + WriteText("profile.txt", "1e-4 2e-7\n"), 3);
  const std::size_t said = m_Message.find("cannot be checked");
  ASSERT_NE(said, std::string::npos) << m_Message;
  EXPECT_EQ(m_Message.find("cannot be checked", said + 1), std::string::npos) << m_Message; // once for all channels
}

TEST_F(EstimateProfileTool, LevelsThatAreMissingAreAskedForAndTheReportIsWritten)
{
  Burst();
  const auto profile = WriteText("profile.txt", "1e-4 2e-7\n");
  const auto report = ReportOf("burst.mha --check-profile " + profile, 3);
  EXPECT_FALSE(report.contains("profile_check"));
  EXPECT_NE(m_Message.find("error: the profile profile.txt cannot be checked"), std::string::npos) << m_Message;
  EXPECT_NE(m_Message.find("--black"), std::string::npos) << m_Message;
}

TEST_F(EstimateProfileTool, LevelsOfADngFileAreTakenWhereNothingElseGivesThem)
{
  Burst();
  sensornoise::test::DngOf photo = sensornoise::test::DngOf::Sound();
  photo.tags = { { 50714, { 4, { 100 } } }, { 50717, { 4, { 4095 } } } };
  WriteText("photo.dng", photo.Bytes());
  EXPECT_EQ(Export("report.json --black 100 --white 4095 --format dng --into photo.dng --output copy.dng"), 0)
    << m_Message;
  EXPECT_EQ(Check("copy.dng", "--dark dark.mha")["verdict"], "fits");
  EXPECT_EQ(Check("copy.dng", "--dark dark.mha --white 8190")["verdict"], "does-not-fit");
}

TEST_F(EstimateProfileTool, FilesThatAreNoProfileAreRefusedBeforeTheMeasurement)
{
  const std::string frames = Write("burst.mha", MakeBurst().GetPointer()) + " --check-profile ";
  IsRefused(frames + "nowhere.json", { "nowhere.json", "--check-profile" });
  IsRefused(frames + WriteText("cut.json", "{\"gain\": 1"), { "cut.json", "whole file" });
  IsRefused(frames + WriteText("deep.json", std::string(100000, '[')), { "deep.json", "64 levels" });
  IsRefused(frames + WriteText("presets.json", R"({"version": 0, "noiseprofiles": [{"maker": "A"}]})"),
            { "darktable", "no preset" });
  IsRefused(frames + WriteText("inverse.json",
                               R"({"gain": {"value": 2, "unit": "adu / electron"}, "readnoise": {"value": 3}})"),
            { "gain in \"adu / electron\"", "expected \"electron / adu\"" });
  IsRefused(frames + WriteText("other.txt", "hello"), { "other.txt", "no format that is known" });
  IsRefused(frames + "presets.json --method published", { "--check-profile", "--method refined" });
  IsRefused("burst.mha --black 64", { "--black", "--check-profile" });
}
