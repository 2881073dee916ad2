// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

// Programs whose model has another form: the fit is as near as its note says.

using namespace sensornoise;

class FittedExports : public ExportTest
{
protected:
  /** Returns the relative error of libcamera's standard deviation by its own formula [%], between the black and the
   * white level, at even distances of the root of the signal. */
  std::vector<double>
  LibcameraErrors(const std::string & text, double analogueGain) const
  {
    const double        constant = NumberAfter(text, "\"reference_constant\": ");
    const double        slope16 = NumberAfter(text, "\"reference_slope\": ") / 1.4;
    const double        scale = std::exp2(16 - 12);
    std::vector<double> errors;
    for (double root = 0.0; root * root <= white - black; root += 0.02)
    {
      const double measured = scale * std::sqrt(slope * (black + root * root) + m_Intercept);
      const double fitted = std::sqrt(analogueGain) * (constant + slope16 * std::sqrt(scale) * root); // noise.cpp
      errors.push_back(100.0 * std::abs(fitted / measured - 1.0));
    }
    return errors;
  }

  double m_Intercept{ intercept };
};

TEST_F(FittedExports, LibcameraIsAsNearAsItSays)
{
  ExportSettings settings;
  settings.analogueGain = 2.0;
  for (const double darkVariance : { 0.25, 2.0, 16.0 })
  {
    m_Intercept = darkVariance - slope * black;
    this->SetQuantity("/total_intercept", m_Intercept);
    const auto   made = this->Export("libcamera", settings);
    const auto   errors = LibcameraErrors(made.files.at(0).bytes, 2.0);
    const double largest = *std::max_element(errors.begin(), errors.end());
    const double rms = std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) /
                                 static_cast<double>(errors.size()));
    // The note has three digits, and the dark end counts twice in its sum over 4096 levels.
    EXPECT_NEAR(NumberAfter(made.note, "(rms), and by "), largest, 0.005 * largest) << darkVariance;
    EXPECT_NEAR(NumberAfter(made.note, "measured one by "), rms, 0.02 * rms) << darkVariance;
    EXPECT_EQ(NumberAfter(made.note, " at most, at "), black); // a sum of roots is no root of a sum
  }
}

// noise.cpp of libcamera: both numbers times the root of the analogue gain, on levels of 16 bits.
TEST_F(FittedExports, LibcameraMultipliesBothNumbersByTheRootOfTheGain)
{
  CameraNoise noise = ReadCameraNoise(m_Report);
  noise.analogueGain = 4.0;
  const double deviation16 = 2.0 * (10.0 + 3.0 * std::sqrt(16.0 * 25.0)); // 25 DN of 12 bits above black
  EXPECT_NEAR(LibcameraVariance({ 10.0, 1.4 * 3.0 }, noise, black + 25.0), std::pow(deviation16 / 16.0, 2.0), 1e-9);
  // A burst with four times the variance at the gain 4 has the numbers of a burst at the gain 1.
  const double dark = 400.0;
  this->SetQuantity("/total_intercept", dark - slope * black);
  const std::string expected = TextOf("libcamera");
  ASSERT_GT(NumberAfter(expected, "\"reference_constant\": "), 100.0);
  this->SetQuantity("/variance_slope", 4.0 * slope);
  this->SetQuantity("/total_intercept", 4.0 * (dark - slope * black));
  ExportSettings settings;
  settings.analogueGain = 4.0;
  EXPECT_EQ(TextOf("libcamera", settings), expected);
}

TEST_F(FittedExports, LibcameraOfANoiselessDarkIsExact)
{
  // Without variance at black the standard deviation is a root: slope 1.4 sqrt(a k), to 3 digits.
  this->SetQuantity("/total_intercept", -slope * black);
  const std::string text = TextOf("libcamera");
  EXPECT_EQ(NumberAfter(text, "\"reference_constant\": "), 0.0);
  EXPECT_NEAR(NumberAfter(text, "\"reference_slope\": "), 1.4 * std::sqrt(slope * 16.0), 0.0005);
}

TEST_F(FittedExports, LibcameraNeedsTheBitDepth)
{
  m_Report.numbers.erase("/camera/bit_depth");
  IsRefused("libcamera", { "no bit depth", "integer" });
  m_Report.numbers["/bit_depth"] = 12;
  EXPECT_NE(TextOf("libcamera"), "");
}

class AndroidExport : public ExportTest
{
protected:
  static constexpr double maxAnalogueIso = 400.0;

  /** Returns a report at an ISO speed of a camera that has Android's model: S = A iso + B, O = C iso^2 + D d^2. */
  CameraNoise
  ReportAt(double iso)
  {
    this->MakeMosaic();
    m_Report.numbers["/camera/iso_speed"] = iso;
    const double range = white - black;
    const double digital = std::max(1.0, iso / maxAnalogueIso);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const double scale = a[i] * iso + b;
      const double darkVariance = c * iso * iso + d * digital * digital;
      const auto   at = "/channels/" + std::to_string(i);
      this->SetQuantity(at + "/variance_slope", scale * range);
      this->SetQuantity(at + "/total_intercept", darkVariance * range * range - scale * range * black);
    }
    ExportSettings settings;
    settings.maxAnalogueIso = maxAnalogueIso;
    return ReadCameraNoise(m_Report, settings);
  }
  static std::vector<double>
  ListOf(const std::string & text, const std::string & name)
  {
    std::vector<double> numbers;
    std::size_t         at = text.find('[', text.find(name));
    for (; text[at] != ']'; at = text.find_first_of(",]", at + 1))
    {
      numbers.push_back(std::strtod(text.c_str() + at + 1, nullptr));
    }
    return numbers;
  }

  static constexpr double a[4]{ 1e-6, 2e-6, 2.1e-6, 3e-6 };
  static constexpr double b{ 5e-6 };
  static constexpr double c{ 2e-13 };
  static constexpr double d{ 4e-9 };
};

TEST_F(AndroidExport, CoefficientsAreThoseOfTheCamera)
{
  const auto        made = ExportNoise("android", { ReportAt(100), ReportAt(200), ReportAt(800), ReportAt(1600) });
  const std::string text = made.files.at(0).bytes;
  EXPECT_NE(text.find("\"channels\": [\"R\", \"Gr\", \"Gb\", \"B\"]"), std::string::npos) << text;
  const auto foundA = ListOf(text, "noise_model_A");
  const auto foundB = ListOf(text, "noise_model_B");
  const auto foundC = ListOf(text, "noise_model_C");
  const auto foundD = ListOf(text, "noise_model_D");
  ASSERT_EQ(foundA.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(foundA[i], a[i], 1e-8 * a[i]);
    EXPECT_NEAR(foundB[i], b, 1e-8 * b);
    EXPECT_NEAR(foundC[i], c, 1e-8 * c);
    EXPECT_NEAR(foundD[i], d, 1e-8 * d);
  }
  EXPECT_LT(NumberAfter(made.note, "measured variance by "), 1e-6);
}

TEST_F(AndroidExport, NoCoefficientOfTheOffsetIsNegative)
{
  CameraNoise dark = ReportAt(100);
  CameraNoise bright = ReportAt(200);
  for (ChannelNoise & channel : bright.channels)
  {
    *channel.totalIntercept.value = 1.0 - *channel.varianceSlope.value * black; // less than at ISO 100
  }
  for (ChannelNoise & channel : dark.channels)
  {
    *channel.totalIntercept.value = 2.0 - *channel.varianceSlope.value * black;
  }
  const std::string text = ExportNoise("android", { dark, bright }).files.at(0).bytes;
  for (const double number : ListOf(text, "noise_model_C"))
  {
    EXPECT_EQ(number, 0.0);
  }
  for (const double number : ListOf(text, "noise_model_D"))
  {
    EXPECT_GT(number, 0.0);
  }
}

TEST_F(AndroidExport, ReportsThatAreNotARangeAreRefused)
{
  const CameraNoise one = ReportAt(100);
  CameraNoise       other = ReportAt(200);
  const auto        refused = [](const std::vector<CameraNoise> & settings, const std::string & part) {
    try
    {
      ExportNoise("android", settings);
      ADD_FAILURE() << part;
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused({ one },
          "1 report was given; android takes 2 or more, each of a different ISO speed. Measure bursts at more");
  refused({ one, one }, "all reports have the ISO speed 100");
  other.channels.pop_back();
  refused({ one, other }, "4 and 3 channels");
  other.isoSpeed.reset();
  refused({ one, other }, "no ISO speed");
  refused({ one, other }, "--sweep and folders named by their ISO speeds, as iso100");
}
