// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "helpers/PageTestHelper.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
using test::Contains;

ChannelNoise
ChannelOf(const std::string & name, double gain, double electrons)
{
  const auto   reported = [](double value, double error) { return ReportedNumber{ value, error, "identified" }; };
  ChannelNoise channel;
  channel.channel = name;
  channel.gain = reported(gain, 0.003 * gain);
  channel.offset = reported(64.0, 0.5);
  channel.readNoise = reported(electrons * gain, 0.01 * electrons * gain);
  channel.readNoiseElectronsError = 0.01 * electrons;
  channel.clipHighDn = 4064.0;
  return channel;
}

/** Returns a mosaic at 8 ISO speeds, whose red is scaled by 2, and whose conversion gain switches between 400 and 800.
 */
MeasuredRange
MosaicRange()
{
  MeasuredRange range;
  for (const double iso : { 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0, 6400.0, 12800.0 })
  {
    const double electrons = std::hypot(iso >= 800.0 ? 1.0 : 3.0, 500.0 / iso);
    CameraNoise  noise;
    noise.camera = "Camera & Co";
    noise.channels = { ChannelOf("R", 0.004 * iso, electrons), ChannelOf("G1", 0.002 * iso, electrons) };
    range.settings.push_back(iso);
    range.noise.push_back(noise);
  }
  return range;
}
} // namespace

// Closed form: full well (4064 - 64) / 0.2 e-, dynamic range 20 log10(full well / read noise).
TEST(SweepSummary, HasTheNumbersOfEachChannel)
{
  const SweepSummary summary = SummariseSweep(MosaicRange());
  ASSERT_EQ(summary.rows.size(), 16U);
  const SweepRow & row = summary.rows[1];
  EXPECT_EQ(row.channel, "G1");
  EXPECT_EQ(row.setting, 100.0);
  EXPECT_DOUBLE_EQ(row.gain->value, 0.2);
  EXPECT_DOUBLE_EQ(row.readNoiseElectrons->value, std::hypot(3.0, 5.0));
  EXPECT_DOUBLE_EQ(row.fullWellElectrons->value, 20000.0);
  EXPECT_NEAR(row.fullWellElectrons->standardError, 20000.0 * std::hypot(0.5 / 4000.0, 0.003), 1e-9);
  EXPECT_NEAR(row.dynamicRangeDb->value, 20.0 * std::log10(20000.0 / std::hypot(3.0, 5.0)), 1e-9);
  EXPECT_NEAR(row.dynamicRangeDb->standardError, 8.685889638 * std::hypot(0.5 / 4000.0, 0.01), 1e-9);
}

TEST(SweepSummary, TakesTheWhiteLevelWherePixelsDoNotSaturate)
{
  MeasuredRange range = MosaicRange();
  range.noise[0].channels[1].clipHighDn.reset();
  EXPECT_FALSE(SummariseSweep(range).rows[1].fullWellElectrons);
  range.noise[0].whiteLevelDn = 1064.0;
  EXPECT_DOUBLE_EQ(SummariseSweep(range).rows[1].fullWellElectrons->value, 5000.0);
}

TEST(SweepSummary, FitsAndroidsModelToIsoSpeeds)
{
  MeasuredRange range = MosaicRange();
  EXPECT_TRUE(Contains(SummariseSweep(range).androidReason, "no ISO speed"));
  for (std::size_t i = 0; i < range.noise.size(); ++i)
  {
    CameraNoise & noise = range.noise[i];
    noise.isoSpeed = range.settings[i];
    noise.whiteLevelDn = 4064.0;
    for (ChannelNoise & channel : noise.channels)
    {
      channel.varianceSlope = channel.gain;
      channel.totalIntercept.value = std::pow(*channel.readNoise.value, 2.0) - *channel.gain.value * 64.0;
    }
  }
  // A sweep has no option for the levels.
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)), "no black level"));
  EXPECT_FALSE(Contains(MakeText(SummariseSweep(range)), "(--black)"));
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)),
                       "export-noise-model passport.json --format android --black BLACK --white WHITE"));
  for (CameraNoise & noise : range.noise)
  {
    noise.blackLevelDn = 64.0;
  }
  EXPECT_EQ(SummariseSweep(range).android->files[0].bytes, ExportNoise("android", range.noise).files[0].bytes);
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)), "Android's noise model: The fitted variance differs"));
  range.kind = SettingKind::Gain;
  EXPECT_FALSE(SummariseSweep(range).android);
  EXPECT_EQ(SummariseSweep(range).androidReason, "");
}

TEST(SweepSummary, HasThePresetsOfDarktable)
{
  MeasuredRange range = MosaicRange();
  for (std::size_t i = 0; i < range.noise.size(); ++i)
  {
    CameraNoise & noise = range.noise[i];
    noise.isoSpeed = range.settings[i];
    noise.blackLevelDn = 64.0;
    for (ChannelNoise & channel : noise.channels)
    {
      channel.varianceSlope = channel.gain;
      channel.totalIntercept.value = std::pow(*channel.readNoise.value, 2.0) - *channel.gain.value * 64.0;
    }
    noise.channels = { noise.channels[1] };
    noise.channels[0].channel = "mono";
  }
  // Both programs need the white level: one sentence says so.
  EXPECT_TRUE(Contains(SummariseSweep(range).darktableReason, "no white level"));
  EXPECT_FALSE(Contains(MakeText(SummariseSweep(range)), "darktable"));
  for (CameraNoise & noise : range.noise)
  {
    noise.whiteLevelDn = 4064.0;
  }
  EXPECT_EQ(SummariseSweep(range).darktable->files[0].bytes, ExportNoise("darktable", range.noise).files[0].bytes);
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)), "darktable's presets are in the passport: export-noise-model"));
  EXPECT_TRUE(Contains(ToJson(SummariseSweep(range)), "noiseprofiles"));
  for (CameraNoise & noise : range.noise)
  {
    noise.channels[0].channel = "R"; // red alone is no mosaic
  }
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)), "darktable's presets are not made: "))
    << MakeText(SummariseSweep(range));
  range.kind = SettingKind::Gain;
  EXPECT_FALSE(SummariseSweep(range).darktable);
  EXPECT_EQ(SummariseSweep(range).darktableReason, "");
}

// The geometric mean of 0.4 and 0.2 DN/e- at ISO 100; a channel that is missing at one setting is left out of all.
TEST(SweepSummary, AveragesTheChannelsThatAllSettingsHave)
{
  MeasuredRange range = MosaicRange();
  EXPECT_NEAR(MeanOverChannels(range)[0].gain->value, std::sqrt(0.08), 1e-12);
  EXPECT_NEAR(MeanOverChannels(range)[0].gain->standardError, std::sqrt(0.08) * 0.003 / std::sqrt(2.0), 1e-12);
  range.noise[7].channels[0].gain = { {}, {}, "failed" };
  EXPECT_NEAR(MeanOverChannels(range)[0].gain->value, 0.2, 1e-12);
  EXPECT_NEAR(SummariseSweep(range).line.parts.at(0).scale.value, 0.002, 1e-12);
  // one setting that has red alone does not take the others' green
  range.noise[6].channels[1].gain = { {}, {}, "failed" };
  EXPECT_FALSE(MeanOverChannels(range)[6].gain);
  EXPECT_NEAR(MeanOverChannels(range)[7].gain->value, 25.6, 1e-12);
  range.noise[3].channels.clear(); // a setting without any channel is no reason to leave others out
  EXPECT_FALSE(MeanOverChannels(range)[3].gain);
  EXPECT_GT(MeanOverChannels(range)[0].gain->value, 0.1);
}

TEST(SweepSummary, SaysWhatItFound)
{
  MeasuredRange range = MosaicRange();
  range.noise[0].channels[0].gain.value = 0.8; // ISO 100 is an extended one
  range.noise[0].channels[1].gain.value = 0.4;
  const SweepSummary summary = SummariseSweep(range, { { "iso25600", 25600.0, "the frames <differ>" } });
  const std::string  text = MakeText(summary);
  EXPECT_TRUE(Contains(text, "Camera & Co: 8 of 9 settings measured")) << text;
  EXPECT_TRUE(Contains(text, "ISO 100 leaves the line: its gain is 100 % above it")) << text;
  EXPECT_TRUE(Contains(text, "switched between ISO 400 and ISO 800: the read noise in electrons falls to 0.")) << text;
  EXPECT_TRUE(Contains(text, "not measured: ISO 25600 (iso25600): the frames <differ>")) << text;
  const std::string page = ToHtml(summary);
  EXPECT_TRUE(Contains(page, "the frames &lt;differ&gt;"));
  EXPECT_TRUE(Contains(page, "gain is 100 % above it"));
  for (const char * const name :
       { "gain [DN/e⁻]", "read noise [e⁻]", "read noise [DN]", "full well [e⁻]", "dynamic range [dB]", "offset [DN]" })
  {
    EXPECT_TRUE(Contains(page, std::string(name) + " of every setting with its 95 % interval")) << name;
  }
  test::ExpectSound(page);
  for (const char * const tick : { ">100<", ">500<", ">10000<", ">1.5<", ">4<" }) // ISO speeds; electrons
  {
    EXPECT_TRUE(Contains(page, tick)) << tick;
  }
}

// The offset is 64 at all settings, within an interval of 62 to 66: its axis is linear. The full well is 1e6 / ISO, or
// half of it: its axis is logarithmic.
TEST(SweepSummary, DrawsEachNumberOnItsAxis)
{
  const std::string page = ToHtml(SummariseSweep(MosaicRange()));
  const auto        figureOf = [&page](const std::string & name) {
    const std::size_t begin = page.find(name + " of every setting");
    return page.substr(std::min(begin, page.size()), page.find("</svg>", begin) - begin);
  };
  EXPECT_TRUE(Contains(figureOf("offset [DN]"), ">64.0<")) << figureOf("offset [DN]");
  EXPECT_TRUE(Contains(figureOf("full well [e⁻]"), ">1000<")) << figureOf("full well [e⁻]");
  EXPECT_TRUE(Contains(figureOf("dynamic range [dB]"), ">60<")) << figureOf("dynamic range [dB]");
  EXPECT_TRUE(Contains(figureOf("read noise [DN]"), ">10<")) << figureOf("read noise [DN]");

  MeasuredRange range = MosaicRange();
  for (CameraNoise & noise : range.noise)
  {
    for (ChannelNoise & channel : noise.channels)
    {
      channel.offset = { -3.0, 0.5, "identified" };
      channel.clipHighDn.reset();
    }
  }
  const std::string other = ToHtml(SummariseSweep(range));
  EXPECT_TRUE(Contains(other, "offset [DN] of every setting") && Contains(other, ">−3.0<")) << other;
  EXPECT_TRUE(Contains(other, "full well [e⁻]: no setting has a value"));
}

TEST(SweepSummary, SaysWhyThereIsNoLine)
{
  MeasuredRange range = MosaicRange();
  for (CameraNoise & noise : range.noise)
  {
    noise.channels = { ChannelOf("mono", 0.5, 3.0) };
  }
  EXPECT_TRUE(Contains(MakeText(SummariseSweep(range)), "The gains do not follow the settings"));
  EXPECT_TRUE(Contains(MakeText(SummariseSweep({})), "0 of 0 settings measured"));
  EXPECT_TRUE(Contains(MakeText(SummariseSweep({})), "there are 0"));
  EXPECT_TRUE(Contains(ToHtml(SummariseSweep({})), "gain [DN/e⁻]: no setting has a value"));
}

} // namespace sensornoise
