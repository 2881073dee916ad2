// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameFile.h"

#include <gtest/gtest.h>
#include <string>

namespace
{

std::string
Shown(const std::string & text)
{
  const std::string shown = sensornoise::FileError("a.tif", text).what();
  return shown.substr(7);
}

TEST(FileError, IsOneLineOfText)
{
  EXPECT_STREQ(sensornoise::FileError("a.tif", "is a folder").what(), "a.tif: is a folder");
  EXPECT_EQ(Shown("a\nb\r\tc\x7F"), "a?b??c?");
  EXPECT_EQ(Shown(std::string("a\0b", 3)), "a?b");
  // ä € and a clef of four bytes
  EXPECT_EQ(Shown("\xC3\xA4 \xE2\x82\xAC \xF0\x9D\x84\x9E"), "\xC3\xA4 \xE2\x82\xAC \xF0\x9D\x84\x9E");
}

TEST(FileError, WhatIsNoUtf8IsShownAsAQuestionMark)
{
  EXPECT_EQ(Shown("\xC3"), "?");
  EXPECT_EQ(Shown("\xC3(\xA4"), "?(?");
  EXPECT_EQ(Shown("\xFF\xC0\x80"), "???");
  EXPECT_EQ(Shown("\xE0\x80\x80"), "???");      // longer than it must be
  EXPECT_EQ(Shown("\xED\xA0\x80"), "???");      // half of a pair
  EXPECT_EQ(Shown("\xF4\x90\x80\x80"), "????"); // beyond the last one
  EXPECT_EQ(Shown("\xC2\x85\xE2\x82"), "????"); // a control character, and what is cut off
}

} // namespace
