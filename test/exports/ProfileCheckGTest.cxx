// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/ProfileTestHelper.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

using namespace sensornoise;

namespace
{
constexpr double otherGain = 0.3; // DN/e-: neither it nor its inverse is a power of two
const char *     exchanged = "e-/ADU and ADU/e- are exchanged";
const char *     otherScale = "its levels are 16 times too high, as for another white level or bit depth";
const char *     lostBlack = "the black level of 64 DN is not subtracted";

/** A camera of another gain: with 0.5 DN/e-, the inverse is also a factor of 4. */
class ProfileMistakes : public ProfileTest
{
protected:
  static constexpr double range = white - black;
  static constexpr double dark = 9.0; // variance at the dark offset [DN^2]: of a read noise of 10 e-

  void
  SetUp() override
  {
    ProfileTest::SetUp();
    this->SetQuantity("/variance_slope", otherGain);
    this->SetQuantity("/total_intercept", dark - otherGain * offset);
    this->SetQuantity("/gain", otherGain);
    this->SetQuantity("/read_noise", std::sqrt(dark));
  }
  void
  Names(const NoiseProfile & profile, const std::string & words, const ExportSettings & settings = {}) const
  {
    SCOPED_TRACE(static_cast<int>(profile.form));
    const auto check =
      CheckNoiseProfile(profile, Frames(otherGain, dark - otherGain * offset), ReadCameraNoise(m_Report, settings));
    EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::DoesNotFit);
    const std::size_t colon = check.sentence.find(" DN: ");
    ASSERT_NE(colon, std::string::npos) << check.sentence;
    EXPECT_EQ(check.sentence.substr(colon + 5), words) << check.sentence;
  }
};
} // namespace

TEST_F(ProfileMistakes, ExchangedGain)
{
  Names(SensorProfile(otherGain, 10.0, offset), exchanged);
  Names(LineProfile(1.0 / otherGain, dark - offset / otherGain), exchanged);
  Names(NormalisedProfile(1.0 / otherGain / range, dark / (range * range)), exchanged);
}

// The exchanged numbers may be the gain alone, or the gain with the offset of its line.
TEST_F(ProfileMistakes, ExchangedGainWithTheTrueIntercept)
{
  Names(LineProfile(1.0 / otherGain, dark - otherGain * offset), exchanged);
}

TEST_F(ProfileMistakes, ExchangedScaleAndOffset)
{
  const double scale = otherGain / range;
  Names(NormalisedProfile(dark / (range * range), scale), "scale and offset are exchanged");
}

TEST_F(ProfileMistakes, DifferencesOfFramesAreHalvedOnce)
{
  const std::string high = "all variances are 2 times too high, as of a difference of two frames that is not halved";
  const std::string low = "all variances are 2 times too low, as of a difference of two frames that is halved twice";
  for (const auto & [factor, words] : { std::pair(2.0, high), std::pair(0.5, low) })
  {
    Names(LineProfile(factor * otherGain, factor * (dark - otherGain * offset)), words);
    Names(NormalisedProfile(factor * otherGain / range, factor * dark / (range * range)), words);
    Names(SensorProfile(1.0 / (factor * otherGain), 10.0 / std::sqrt(factor), offset), words);
  }
}

TEST_F(ProfileMistakes, VarianceInElectrons)
{
  const double square = 1.0 / (otherGain * otherGain);
  Names(LineProfile(1.0 / otherGain, square * (dark - otherGain * offset)), "the variance is in e-^2 in place of DN^2");
}

TEST_F(ProfileMistakes, BlackLevel)
{
  Names(SensorProfile(1.0 / otherGain, 10.0, 0.0), lostBlack);
  Names(LineProfile(otherGain, dark), lostBlack);
  ExportSettings settings;
  settings.blackLevelDn = 300.0; // black level that the reader gives; the frames have another one
  Names(NormalisedProfile(otherGain / (white - 300.0), dark / ((white - 300.0) * (white - 300.0))),
        "the black level is 300 DN in the profile and 64 DN in the frames",
        settings);
}

TEST_F(ProfileMistakes, OtherScale)
{
  Names(SensorProfile(1.0 / otherGain / 16.0, 10.0, 16.0 * offset), otherScale);
  Names(LineProfile(16.0 * otherGain, 256.0 * (dark - otherGain * offset)), otherScale);
  Names(NormalisedProfile(16.0 * otherGain / range, 256.0 * dark / (range * range)), otherScale);
}

TEST_F(ProfileMistakes, DoubledGain)
{
  Names(SensorProfile(2.0 / otherGain, 20.0, offset), "its gain is 2 times too low");
  Names(LineProfile(2.0 * otherGain, dark - 2.0 * otherGain * offset), "its gain is 2 times too high");
  Names(NormalisedProfile(2.0 * otherGain / range, dark / (range * range)), "its gain is 2 times too high");
}

TEST_F(ProfileMistakes, ReadNoise)
{
  Names(SensorProfile(1.0 / otherGain, std::sqrt(dark), offset), "the read noise is in DN in place of e-");
  Names(SensorProfile(1.0 / otherGain, 100.0, offset), "the read noise has the value of a variance");
  Names(LineProfile(otherGain, dark / (otherGain * otherGain) - otherGain * offset),
        "the read noise is in e- in place of DN");
  Names(NormalisedProfile(otherGain / range, std::sqrt(dark) / range),
        "the dark variance has the value of a standard deviation");
}

TEST_F(ProfileMistakes, FloorOfTheVariance)
{
  NoiseProfile profile = LineProfile(otherGain, dark - otherGain * offset);
  profile.floorDn2 = 125.0; // CAREamics' default
  Names(profile, "min_sigma is the lowest variance, and 125 DN^2 is too high");
}

TEST_F(ProfileMistakes, AnythingElseIsNotNamed)
{
  const auto check = CheckNoiseProfile(LineProfile(1.3 * otherGain, 1.3 * (dark - otherGain * offset)),
                                       Frames(otherGain, dark - otherGain * offset),
                                       ReadCameraNoise(m_Report));
  EXPECT_NE(check.sentence.find("1.3 times too high"), std::string::npos) << check.sentence;
  EXPECT_NE(check.sentence.find("no known mistake explains it"), std::string::npos) << check.sentence;
}

class ProfileCheck : public ProfileTest
{};

TEST_F(ProfileCheck, FactorStandsInTheSentence)
{
  const auto check = Check(LineProfile(0.5 * slope, 0.5 * intercept));
  EXPECT_EQ(check.sentence.find("the profile profile (test) is 2.0 times too low at "), 0U) << check.sentence;
}

TEST_F(ProfileCheck, FewPercentAreNoContradiction)
{
  EXPECT_EQ(Check(LineProfile(1.045 * slope, 1.045 * intercept)).verdict, NoiseModelCheck::Verdict::Fits);
  EXPECT_EQ(Check(LineProfile(1.06 * slope, 1.06 * intercept)).verdict, NoiseModelCheck::Verdict::DoesNotFit);
}

TEST_F(ProfileCheck, TooFewPixelsAreNotTested)
{
  Report frames = Frames();
  for (auto & count : frames.scatter.count)
  {
    count = 1; // a band's relative error is about 0.06
  }
  const auto check = CheckNoiseProfile(LineProfile(1.1 * slope, 1.1 * intercept), frames, ReadCameraNoise(m_Report));
  EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::NotDetermined) << check.sentence;
}

TEST_F(ProfileCheck, ProfileWithoutVarianceSaysWhere)
{
  const auto check = Check(LineProfile(slope, -slope * 500.0));
  EXPECT_NE(check.sentence.find("has no variance at "), std::string::npos) << check.sentence;
}

// The best values of libcamera's formula may be far from the line: no mistake, and no reason to use them unseen.
TEST_F(ProfileCheck, MisfitOfLibcamerasFormulaIsNotCalledUsable)
{
  constexpr double dark = 2000.0;
  this->SetQuantity("/total_intercept", dark - slope * offset);
  const CameraNoise burst = ReadCameraNoise(m_Report);
  const auto        best = FitLibcamera(burst);
  const auto        check = CheckNoiseProfile(
    ProfileOf(ProfileForm::Root, best.slope, best.constant), Frames(slope, dark - slope * offset), burst);
  double largest = 0.0;
  for (const auto & band : check.bands)
  {
    largest = std::max(largest, std::abs(band.ratio.value_or(0.0) - 1.0));
  }
  ASSERT_GT(largest, 0.08);
  EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::Fits);
  EXPECT_EQ(check.sentence.find("can be used"), std::string::npos) << check.sentence;
  EXPECT_NE(check.sentence.find("times too "), std::string::npos) << check.sentence;
  EXPECT_NE(check.sentence.find("libcamera's formula"), std::string::npos) << check.sentence;
}

// Averages of neighbours lower the variance of the frames: the record of the sensor stays true.
TEST_F(ProfileCheck, SmoothedFramesHaveTheSensorsRecord)
{
  constexpr double smoothing = 0.4;
  constexpr double sensorDark = readNoise * readNoise;
  this->SetQuantity("/variance_slope", smoothing * slope);
  this->SetQuantity("/total_intercept", smoothing * (sensorDark - gain * offset));
  const auto check = CheckNoiseProfile(SensorProfile(1.0 / gain, readNoise / gain, offset),
                                       Frames(smoothing * slope, smoothing * (sensorDark - gain * offset)),
                                       ReadCameraNoise(m_Report));
  EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::Fits) << check.sentence;
  EXPECT_NEAR(check.bands.front().ratio.value_or(0.0), 1.0, 1e-6);
}

// Multiplied electrons have more shot noise than the record of the sensor says. The read noise is as it says.
TEST_F(ProfileCheck, MultipliedElectronsHaveTheSensorsRecord)
{
  constexpr double factor = 2.0;
  constexpr double noise = 40.0; // DN: as much as the shot noise of 1,600 electrons
  m_Report.numbers["/settings/excess_noise_factor"] = factor;
  this->SetQuantity("/variance_slope", factor * gain);
  this->SetQuantity("/total_intercept", noise * noise - factor * gain * offset);
  this->SetQuantity("/read_noise", noise);
  const Report frames = Frames(factor * gain, noise * noise - factor * gain * offset);
  for (const auto & readNoiseElectrons : { std::optional<double>(noise / gain), std::optional<double>() })
  {
    const auto check =
      CheckNoiseProfile(SensorProfile(1.0 / gain, readNoiseElectrons, offset), frames, ReadCameraNoise(m_Report));
    EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::Fits) << check.sentence;
    EXPECT_NEAR(check.bands.front().ratio.value_or(0.0), 1.0, 1e-6);
  }
  const auto check = CheckNoiseProfile(SensorProfile(gain, noise / gain, offset), frames, ReadCameraNoise(m_Report));
  EXPECT_NE(check.sentence.find(exchanged), std::string::npos) << check.sentence;
}

// Without a read noise in the file and in the report, the variance of the burst's line at its own dark level is taken.
TEST_F(ProfileCheck, AnOffsetIsTestedWithoutAReadNoise)
{
  this->RemoveQuantity("/read_noise", "not-identifiable");
  const auto checkOf = [this](double offsetDn) {
    return CheckNoiseProfile(SensorProfile(1.0 / gain, std::nullopt, offsetDn),
                             Frames(gain, readNoise * readNoise - gain * offset),
                             ReadCameraNoise(m_Report));
  };
  EXPECT_EQ(checkOf(offset).verdict, NoiseModelCheck::Verdict::Fits) << checkOf(offset).sentence;
  EXPECT_EQ(checkOf(offset + 300.0).verdict, NoiseModelCheck::Verdict::DoesNotFit) << checkOf(offset + 300.0).sentence;
  this->RemoveQuantity("/offset", "not-identifiable");
  m_Report.numbers.erase("/camera/black_level");
  const std::string sentence = checkOf(offset + 300.0).sentence;
  EXPECT_NE(sentence.find("the offset is not tested"), std::string::npos) << sentence;
}

TEST_F(ProfileCheck, ChannelsOfAMosaicHaveTheirPlane)
{
  this->MakeMosaic();
  NoiseProfile profile = NormalisedProfile(1.0, 0.0);
  profile.channels.clear();
  for (const auto & [name, factor] : { std::pair("R", 0U), std::pair("G", 1U), std::pair("B", 3U) })
  {
    profile.channels.push_back({ name,
                                 MosaicSlope(factor) / (white - black),
                                 (MosaicIntercept(factor) + MosaicSlope(factor) * black) / std::pow(white - black, 2),
                                 std::nullopt });
  }
  ExportSettings settings;
  for (const auto & [name, factor] :
       { std::pair("R", 0U), std::pair("G1", 1U), std::pair("G2", 1U), std::pair("B", 3U) })
  {
    settings.channel = name;
    const auto check = CheckNoiseProfile(
      profile, Frames(MosaicSlope(factor), MosaicIntercept(factor)), ReadCameraNoise(m_Report, settings));
    EXPECT_EQ(check.verdict, NoiseModelCheck::Verdict::Fits) << name << ": " << check.sentence;
  }
}

TEST_F(ProfileCheck, WhatTheFramesLackIsAskedFor)
{
  const auto isAsked = [this](const NoiseProfile & profile, const std::string & part) {
    try
    {
      Check(profile);
      ADD_FAILURE() << part;
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  m_Report.numbers.erase("/camera/white_level");
  isAsked(NormalisedProfile(1e-4, 1e-7), "--white");
  NoiseProfile crossed = NormalisedProfile(1e-4, 1e-7);
  crossed.whiteLevelDn = 10.0;
  isAsked(crossed, "white level above the black level");
  m_Report.numbers.erase("/camera/black_level");
  isAsked(NormalisedProfile(1e-4, 1e-7), "--black");
  this->RemoveQuantity("/offset", "not-identifiable");
  NoiseProfile profile = SensorProfile(2.0, 3.0, 0.0);
  profile.channels.front().offsetDn.reset();
  isAsked(profile, "--dark");
}
