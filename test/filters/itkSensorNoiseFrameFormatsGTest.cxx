// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "gtest/gtest.h"

#include <string>

// The table of formats.

namespace
{
using namespace sensornoise;

TEST(FrameFormats, AreNamedInSentences)
{
  EXPECT_EQ(NamesOfFrameFormats(), "camera raw, TIFF, PNG, MetaImage, NRRD, SER, MRAW, FITS, NPY or PGM");
}

TEST(FrameFormats, AreRecognisedByContentsFirst)
{
  EXPECT_STREQ(FindFrameFormat("\x89PNG\r\n\x1A\nIHDR:", "a.mha")->name, "PNG");
  EXPECT_STREQ(FindFrameFormat(std::string("II*\0=", 5), "a.mha")->name, "TIFF");
  EXPECT_STREQ(FindFrameFormat("NRRD0004\ntype: short\n", "a.mha")->name, "NRRD");
  EXPECT_STREQ(FindFrameFormat("ObjectType = Image\n", "a.mha")->name, "MetaImage");
  EXPECT_EQ(FindFrameFormat("ObjectType = Image\n", "a.txt"), nullptr);
  EXPECT_EQ(FindFrameFormat("", "a.mha"), nullptr);
}
} // namespace
