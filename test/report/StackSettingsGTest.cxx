// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackSettings.h"

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
using Settings = std::vector<std::pair<std::string, Report::SettingValue>>;

Settings
OfMask(const FrameGeometry & geometry, const std::vector<std::uint8_t> & mask)
{
  Report report;
  NoteMask(report, geometry, mask);
  return report.settings;
}
} // namespace

TEST(SensorNoiseStackSettings, CodesAreNotedWhereTheyWereGiven)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Report           report;
  NoteCodes(report, MakeCodeSettings(0, nan, nan, 0.0));
  EXPECT_EQ(report.settings, Settings{});
  NoteCodes(report, MakeCodeSettings(14, nan, 3000.5, 2.0));
  EXPECT_EQ(report.settings,
            (Settings{ { "bit_depth", 14.0 }, { "clip_high", 3000.5 }, { "quantisation_step", 2.0 } }));
}

// The numbers are those of Python: zlib.crc32(b"3x2:" + bytes([0, 1, 1, 0, 0, 1])).
TEST(SensorNoiseStackSettings, AMaskIsNotedByTheChecksumOfItsShapeAndPixels)
{
  const std::vector<std::uint8_t> mask = { 0, 1, 1, 0, 0, 1 };
  EXPECT_EQ(OfMask({ 3, 2, 1 }, mask), (Settings{ { "mask_crc32", std::string("1215e0df") } }));
  EXPECT_EQ(OfMask({ 2, 3, 1 }, mask), (Settings{ { "mask_crc32", std::string("317d8b7f") } }));
  EXPECT_EQ(OfMask({ 3, 2, 1 }, { 0, 7, 255, 0, 0, 2 }), OfMask({ 3, 2, 1 }, mask)); // what is not 0 is in
  EXPECT_NE(OfMask({ 3, 2, 1 }, { 0, 1, 1, 0, 1, 1 }), OfMask({ 3, 2, 1 }, mask));
  EXPECT_EQ(OfMask({ 3, 2, 1 }, {}), Settings{});
}

TEST(SensorNoiseStackSettings, ASelectionIsNotedWhereThereIsOne)
{
  Report report;
  NoteSelection(report, {});
  EXPECT_EQ(report.settings, Settings{});
  NoteSelection(report, { { { 10, 5, 100, 80 } }, { { 7, 41 } } });
  EXPECT_EQ(report.settings,
            (Settings{ { "roi_x", 10.0 },
                       { "roi_y", 5.0 },
                       { "roi_width", 100.0 },
                       { "roi_height", 80.0 },
                       { "frame_range_first", 7.0 },
                       { "frame_range_end", 41.0 } }));
}
