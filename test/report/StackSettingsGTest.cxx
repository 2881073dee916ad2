// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackReport.h"

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
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

TEST(SensorNoiseStackSettings, DnSettingsAreNotedWhereGiven)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Report           report;
  NoteDnSettings(report, MakeDnSettings(0, nan, nan, 0.0));
  EXPECT_EQ(report.settings, Settings{});
  NoteDnSettings(report, MakeDnSettings(14, nan, 3000.5, 2.0));
  EXPECT_EQ(report.settings,
            (Settings{ { "bit_depth", 14.0 }, { "clip_high", 3000.5 }, { "quantisation_step", 2.0 } }));
}

// The numbers are from Python: zlib.crc32(b"3x2:" + bytes([0, 1, 1, 0, 0, 1])).
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

TEST(SensorNoiseStackSettings, WhatAMethodCannotUseIsRefusedWithItsReason)
{
  for (const std::string setting : { "offset", "dark", "level_range", "exposures", "maps" })
  {
    EXPECT_EQ(ReasonUnused("refined", setting), "");
    EXPECT_NO_THROW(RequireUsed("refined", setting, "it"));
    EXPECT_NE(ReasonUnused("single-image", setting), "");
    EXPECT_EQ(ReasonUnused("published", setting).empty(), setting == "maps");
  }
  EXPECT_THROW(ReasonUnused("refined", "offsets"), std::invalid_argument);
  try
  {
    RequireUsed("published", "level_range", "a range of levels");
    FAIL();
  }
  catch (const std::invalid_argument & error)
  {
    EXPECT_STREQ(error.what(),
                 "a range of levels cannot be used by the method published, which fits all levels: leave out what was "
                 "given, or set the method to refined");
  }
}

TEST(SensorNoiseStackSettings, RangesExcludeTheirBounds)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(ValidateLevelRange({ 5.0, 6.0 }));
  EXPECT_THROW(ValidateLevelRange({ 5.0, 5.0 }), std::invalid_argument);
  EXPECT_THROW(ValidateLevelRange({ 5.0, infinite }), std::invalid_argument);
  EXPECT_NO_THROW(ValidateShutterRows(1e5));
  EXPECT_THROW(ValidateShutterRows(0.0), std::invalid_argument);
  EXPECT_THROW(ValidateShutterRows(1.1e5), std::invalid_argument);
}
