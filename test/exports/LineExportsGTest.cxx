// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <sstream>
#include <string>
#include <vector>

// Each file is read back by the formula of the program that takes it.

class LineExports : public ExportTest
{
protected:
  static std::vector<double>
  NumbersIn(const std::string & text)
  {
    std::istringstream  stream(text);
    std::vector<double> numbers;
    for (double number = 0.0; stream >> number;)
    {
      numbers.push_back(number);
    }
    return numbers;
  }
  /** Returns the variance [DN^2] by a pair of NoiseProfile: standard deviation sqrt(S x + O), x from 0 at black to 1 at
   * white. */
  static double
  ProfileVariance(double scale, double profileOffset, double level)
  {
    const double range = white - black;
    return (scale * (level - black) / range + profileOffset) * range * range;
  }
};

TEST_F(LineExports, NoiseProfileIsTheLine)
{
  const auto pair = NumbersIn(TextOf("dng"));
  ASSERT_EQ(pair.size(), 2U);
  IsTheLine([&](double level) { return ProfileVariance(pair[0], pair[1], level); });
}

TEST_F(LineExports, NoiseProfileOfAMosaicHasThreePlanesWithTheMeanOfBothGreens)
{
  this->MakeMosaic();
  const auto pairs = NumbersIn(TextOf("dng"));
  ASSERT_EQ(pairs.size(), 6U);
  IsTheLine(
    [&](double level) { return ProfileVariance(pairs[0], pairs[1], level); }, MosaicSlope(0), MosaicIntercept(0));
  IsTheLine([&](double level) { return ProfileVariance(pairs[2], pairs[3], level); },
            0.5 * (MosaicSlope(1) + MosaicSlope(2)),
            0.5 * (MosaicIntercept(1) + MosaicIntercept(2)));
  IsTheLine(
    [&](double level) { return ProfileVariance(pairs[4], pairs[5], level); }, MosaicSlope(3), MosaicIntercept(3));
}

TEST_F(LineExports, SettingsReplaceTheLevelsOfTheCamera)
{
  sensornoise::ExportSettings settings;
  settings.whiteLevelDn = 1088.0; // a range of 1024 DN
  EXPECT_DOUBLE_EQ(NumbersIn(TextOf("dng", settings)).at(0), slope / 1024.0);
  settings.blackLevelDn = 2000.0;
  IsRefused("dng", { "white level is 1088", "black level 2000", "expected a white level above" }, settings);
}

TEST_F(LineExports, LevelsThatAreMissingOrWrongAreRefused)
{
  sensornoise::ExportSettings settings;
  settings.blackLevelDn = 50.0; // the line is 0 at 59.8 DN
  IsRefused("dng", { "variance of -4.9", "black level 50 DN", "59.8", "offset is 64.5", "--black" }, settings);
  m_Report.numbers.erase("/camera/white_level");
  IsRefused("dng", { "no white level", "saturate at 4000 DN", "--white" });
  m_Report.numbers.erase("/camera/black_level");
  IsRefused("deepinv", { "no black level", "--black" });
}

TEST_F(LineExports, ALineThatIsNotIdentifiedIsRefused)
{
  this->RemoveQuantity("/total_intercept", "not-identifiable");
  for (const char * format : { "dng", "ndsafir", "anscombe-transform", "deepinv" })
  {
    IsRefused(format, { "report.json", "total_intercept", "not-identifiable" });
  }
  this->SetQuantity("/total_intercept", intercept);
  this->SetQuantity("/variance_slope", -0.1);
  IsRefused("ndsafir", { "variance_slope of -0.1", "above 0" });
}

TEST_F(LineExports, ALineBeyondAllNumbersIsRefused)
{
  this->SetQuantity("/variance_slope", 1e308);
  for (const char * format : { "dng", "deepinv", "libcamera" })
  {
    IsRefused(format, { "report.json", "from 0 (black) to 1 (white)", "finite" });
  }
}

TEST_F(LineExports, AMosaicWithoutAChannelIsRefused)
{
  this->MakeMosaic();
  m_Report.texts.erase("/channels/3/channel");
  IsRefused("dng", { "no channel B", "R, G1, G2 and B", "whole mosaic" });
  sensornoise::ExportSettings settings;
  settings.channel = "G1";
  IsRefused("dng", { "no channel R", "leave out the channel (--channel)" }, settings);
}

// The errors of read noise and offset are 0.5 DN and 2 DN: of the variance hypot(2 x 1.5 x 0.5, 0.5 x 2) DN^2.
TEST_F(LineExports, ANegativeVarianceAtTheBlackLevelHasItsError)
{
  m_Report.numbers["/read_noise/standard_error"] = 0.5;
  m_Report.numbers["/offset/standard_error"] = 2.0;
  m_Report.numbers["/camera/black_level"] = offset - 20.0;
  IsRefused("dng", { "a variance of -7.7 \u00B1 1.8 DN\u00B2 at the black level 44.5 DN", "--black", "--dark" });
  m_Report.numbers.erase("/offset/standard_error");
  IsRefused("dng", { "a variance of -7.6" });
}

TEST_F(LineExports, NdsafirHasTheLineOfEachChannel)
{
  this->MakeMosaic();
  const std::string text = TextOf("ndsafir");
  const auto        list = [&](const std::string & name) {
    const std::size_t begin = text.find('[', text.find("\"" + name + "\"")) + 1;
    std::string       inside = text.substr(begin, text.find(']', begin) - begin);
    for (char & character : inside)
    {
      character = character == ',' ? ' ' : character;
    }
    return NumbersIn(inside);
  };
  const auto gains = list("gains");
  const auto offsets = list("offsets");
  ASSERT_EQ(gains.size(), 4U);
  ASSERT_EQ(offsets.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
  {
    IsTheLine([&](double level) { return gains[i] * level + offsets[i]; }, MosaicSlope(i), MosaicIntercept(i));
  }
}

TEST_F(LineExports, AnscombeTransformIsTheLineToHalfADigitalNumber)
{
  const auto        made = this->Export("anscombe-transform");
  const std::string text = made.files.at(0).bytes;
  const double      conversionGain = NumberAfter(text, "\"conversion_gain\": ");
  const double      zero = NumberAfter(text, "\"zero_level\": ");
  EXPECT_EQ(zero, std::round(-intercept / slope));
  // All variances have the same error, at most half a DN times the slope, which the note gives.
  const double error = conversionGain * (100.0 - zero) - (slope * 100.0 + intercept);
  EXPECT_LE(std::abs(error), 0.5 * slope);
  EXPECT_NEAR(NumberAfter(made.note, "all variances are "), error, 0.01 * std::abs(error));
  IsTheLine([&](double level) { return conversionGain * (level - zero) - error; });
}

TEST_F(LineExports, DeepinvIsTheLineOnLevelsFromZeroToOne)
{
  const std::string text = TextOf("deepinv");
  const double      scale = NumberAfter(text, "\"gain\": ");
  const double      sigma = NumberAfter(text, "\"sigma\": ");
  // y = gain P(x / gain) + sigma n has the variance gain x + sigma^2.
  IsTheLine([&](double level) { return ProfileVariance(scale, sigma * sigma, level); });
  this->MakeMosaic();
  IsRefused("deepinv", { "4 channels", "--channel" });
  sensornoise::ExportSettings settings;
  settings.channel = "B";
  EXPECT_DOUBLE_EQ(NumberAfter(TextOf("deepinv", settings), "\"gain\": "), MosaicSlope(3) / (white - black));
  settings.channel = "G";
  IsRefused("deepinv", { "no channel G", "R, G1, G2, B" }, settings);
}
