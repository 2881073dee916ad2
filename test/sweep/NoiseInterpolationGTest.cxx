// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/Setting.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** Returns a camera of g = 0.002 ISO, an offset of 100 + 0.001 ISO, and 3 electrons of read noise. */
CameraNoise
CameraAt(double iso)
{
  const auto   reported = [](double value, double error) { return ReportedNumber{ value, error, "identified" }; };
  ChannelNoise channel;
  const double gain = 0.002 * iso;
  const double offset = 100.0 + 2.0 * std::log(iso);
  channel.gain = reported(gain, 0.01 * gain);
  channel.varianceSlope = reported(gain, 0.01 * gain);
  channel.offset = reported(offset, 0.1);
  channel.readNoise = reported(3.0 * gain, 0.02 * 3.0 * gain);
  channel.readNoiseElectronsError = 0.06;
  channel.totalIntercept = reported(9.0 * gain * gain - gain * offset, 1.0);
  channel.highestDn = 3000.0 + iso;
  CameraNoise camera;
  camera.name = "passport.json";
  camera.channels = { channel };
  camera.blackLevelDn = 100.0;
  camera.whiteLevelDn = 4095.0;
  camera.isoSpeed = iso;
  return camera;
}

MeasuredRange
RangeOf(const std::vector<double> & settings)
{
  MeasuredRange range;
  range.settings = settings;
  for (const double iso : settings)
  {
    range.noise.push_back(CameraAt(iso));
  }
  return range;
}

void
IsRefused(const MeasuredRange & range, double setting, const std::string & part)
{
  try
  {
    InterpolateNoise(range, setting);
    ADD_FAILURE() << setting << " was interpolated";
  }
  catch (const ExportError & error)
  {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}
} // namespace

// Closed form: a power law is a line, and has the errors of its neighbours alone.
TEST(NoiseInterpolation, IsExactForAPowerLaw)
{
  const auto                 power = [](double setting) { return 3.0 * std::pow(setting, 0.7); };
  std::vector<SettingNumber> points;
  for (const double setting : { 100.0, 200.0, 800.0, 1600.0 })
  {
    points.push_back({ setting, { power(setting), 0.01 * power(setting) } });
  }
  const NumberWithError made = InterpolateNumber(points, 400.0, true);
  EXPECT_NEAR(made.value, power(400.0), 1e-12 * power(400.0));
  EXPECT_NEAR(made.standardError, 0.01 * power(400.0) * std::sqrt(0.5), 1e-12 * power(400.0));
  EXPECT_NEAR(InterpolateNumber(points, 1600.0, true).value, power(1600.0), 1e-12 * power(1600.0));
}

// Closed form: of a parabola in ln(setting), the error is the error of the straight line.
TEST(NoiseInterpolation, HasTheErrorOfAParabola)
{
  const auto parabola = [](double setting) { return 5.0 + 0.3 * std::log(setting) * std::log(setting); };
  for (const std::vector<double> & settings :
       { std::vector<double>{ 100, 300, 800 }, std::vector<double>{ 300, 800, 1000 } })
  {
    std::vector<SettingNumber> points;
    for (const double setting : settings)
    {
      points.push_back({ setting, { parabola(setting), 0.0 } });
    }
    const NumberWithError made = InterpolateNumber(points, 500.0, false);
    EXPECT_NEAR(made.standardError, std::abs(made.value - parabola(500.0)), 1e-12);
    EXPECT_GT(made.standardError, 0.01);
  }
}

TEST(NoiseInterpolation, RefusesToExtrapolateNumbers)
{
  EXPECT_THROW(InterpolateNumber({ { 100, { 1.0, 0.1 } }, { 200, { 2.0, 0.1 } } }, 250, true), std::invalid_argument);
  EXPECT_THROW(InterpolateNumber({ { 100, { 1.0, 0.1 } } }, 100, true), std::invalid_argument);
}

TEST(NoiseInterpolation, GivesTheCameraBetweenItsSettings)
{
  const InterpolatedNoise made = InterpolateNoise(RangeOf({ 100, 200, 800, 1600 }), 400);
  const ChannelNoise      expected = CameraAt(400).channels[0];
  const ChannelNoise &    channel = made.noise.channels.at(0);
  EXPECT_NEAR(channel.gain.value.value(), expected.gain.value.value(), 1e-12);
  EXPECT_NEAR(channel.varianceSlope.value.value(), expected.varianceSlope.value.value(), 1e-12);
  EXPECT_NEAR(channel.offset.value.value(), expected.offset.value.value(), 1e-9);
  EXPECT_NEAR(channel.readNoise.value.value(), expected.readNoise.value.value(), 1e-12);
  EXPECT_NEAR(channel.totalIntercept.value.value(), expected.totalIntercept.value.value(), 1e-9);
  EXPECT_NEAR(channel.readNoiseElectronsError.value(), 0.06 * std::sqrt(0.5), 1e-12);
  EXPECT_EQ(channel.highestDn, 3200.0); // the narrower of both
  EXPECT_EQ(made.noise.isoSpeed, 400.0);
  EXPECT_EQ(made.noise.blackLevelDn, 100.0);
  EXPECT_EQ(made.below, 200.0);
  EXPECT_EQ(made.above, 800.0);
  EXPECT_NE(SentenceOf(made).find("between the measured settings 200 and 800: gain 0.8000 \u00B1 0.0057 DN/e\u207B"),
            std::string::npos)
    << SentenceOf(made);
}

TEST(NoiseInterpolation, LeavesAMeasuredSettingAsItIs)
{
  MeasuredRange range = RangeOf({ 100, 200, 800 });
  range.noise[1].channels[0].gain.value = 0.7;
  const InterpolatedNoise made = InterpolateNoise(range, 200);
  EXPECT_EQ(made.noise.channels[0].gain.value, 0.7);
  EXPECT_EQ(SentenceOf(made), "");
}

TEST(NoiseInterpolation, LacksWhatANeighbourLacks)
{
  MeasuredRange range = RangeOf({ 100, 200, 800, 1600 });
  range.noise[2].channels[0].readNoise = { {}, {}, "upper-limit" };
  range.noise[3].channels[0].gain = { {}, {}, "failed" }; // no neighbour
  const ChannelNoise channel = InterpolateNoise(range, 400).noise.channels.at(0);
  EXPECT_FALSE(channel.readNoise.value);
  EXPECT_EQ(channel.readNoise.status, "not-identifiable");
  EXPECT_NEAR(channel.gain.value.value(), 0.8, 1e-12);
}

TEST(NoiseInterpolation, RefusesOutsideAndAcrossTheSwitch)
{
  MeasuredRange range = RangeOf({ 100, 200, 800, 1600 });
  IsRefused(range, 50, "outside of the measured settings, 100 to 1600");
  IsRefused(range, 3200, "nothing is extrapolated");
  range.noise[3].channels[0].channel = "G1";
  IsRefused(range, 400, "the channels of passport.json and passport.json differ");
  range.noise[3].channels[0].channel = "mono";
  range.switchBetween = { 200, 800 };
  IsRefused(range, 400, "between 200 and 800, where the camera switches its conversion gain");
  // the curve before the switch is nothing for the settings behind it
  range.noise[1].channels[0].gain.value = 100.0;
  EXPECT_NEAR(InterpolateNoise(range, 1000).noise.channels[0].gain.standardError.value(), 2.0 * 0.01, 0.01);
  EXPECT_EQ(InterpolateNoise(range, 150).below, 100.0);
}

} // namespace sensornoise
