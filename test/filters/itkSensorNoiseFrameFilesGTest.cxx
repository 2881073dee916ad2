// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFilesTestHelper.h"
#include "itkRGBPixel.h"

#include <filesystem>
#include <string>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoisetest::files;

/** Files that are no frames, or not all of one kind. */
class SensorNoiseFrameFiles : public FrameFilesTest
{};

TEST_F(SensorNoiseFrameFiles, WhatIsNotAnImageIsRefused)
{
  const std::string good = WriteFrame<unsigned short>("good.tif");
  OpeningIsRefusedWith({}, { "no file was given" });
  OpeningIsRefusedWith({ good, Path("missing.tif") }, { "missing.tif", "does not exist" });
  fs::create_directories(Path("folder.tif"));
  OpeningIsRefusedWith({ good, Path("folder.tif") }, { "folder.tif", "is a folder" });
  OpeningIsRefusedWith({ good, WriteText("empty.tif", "") }, { "empty.tif", "has 0 bytes" });
  OpeningIsRefusedWith({ good, WriteText("text.tif", "Dear reader,\nthis is no image.\n") },
                       { "text.tif", "no image in a format that can be checked" });
}

TEST_F(SensorNoiseFrameFiles, ColoursAreRefused)
{
  for (const std::string extension : { ".png", ".tif", ".mha", ".nrrd" })
  {
    const std::string grey = WriteFrame<unsigned char>("grey" + extension);
    const std::string colour = WriteFrame<itk::RGBPixel<unsigned char>>("colour" + extension);
    OpeningIsRefusedWith({ grey, colour }, { "colour" + extension, "3 components a pixel", "expected 1" });
  }
}

TEST_F(SensorNoiseFrameFiles, DifferentSizesAndComponentTypesAreRefused)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::string first = WriteFrame<unsigned short>("first" + extension);
    OpeningIsRefusedWith({ first, first, WriteFrame<unsigned short>("other" + extension, 0, { { height, width } }) },
                         { "other" + extension + ": 5 x 7 pixels", "first" + extension + " has 7 x 5" });
    OpeningIsRefusedWith(
      { first, WriteFrame<unsigned char>("bytes" + extension) },
      { "bytes" + extension + ": component type unsigned char", "first" + extension + " has unsigned short" });
  }
}

TEST_F(SensorNoiseFrameFiles, AStackAmongFramesIsRefused)
{
  OpeningIsRefusedWith(
    { WriteFrame<short>("frame.tif"), WriteStack<short>("stack.tif") },
    { "stack.tif", "has 4 frames, but", "frame.tif has one; expected stacks alone, or one frame a file" });
}

TEST_F(SensorNoiseFrameFiles, OtherComponentTypesAreRefusedByName)
{
  const std::string expected = "expected unsigned char, unsigned short, short, unsigned int, int, float or double";
  for (const std::string extension : { ".mha", ".nrrd" })
  {
    OpeningIsRefusedWith({ WriteFrame<signed char>("c" + extension) },
                         { "c" + extension, "component type char is", expected });
  }
}

TEST_F(SensorNoiseFrameFiles, AMetaImageThatCannotBeCheckedIsRefused)
{
  const std::string header = "NDims = 3\nDimSize = 1 1 2\nElementType = MET_UCHAR\n";
  OpeningIsRefusedWith({ WriteText("text.mha", header + "BinaryData = False\nElementDataFile = LOCAL\n1 2") },
                       { "text.mha", "BinaryData is False" });
  OpeningIsRefusedWith({ WriteText("size.mha", header + "CompressedData = True\nElementDataFile = LOCAL\nxxxxxxx") },
                       { "size.mha", "without a CompressedDataSize" });
  OpeningIsRefusedWith({ WriteText("pattern.mhd", header + "ElementDataFile = part%03d 0 1 1\n") },
                       { "pattern.mhd", "is the pattern part%03d" });
  OpeningIsRefusedWith({ WriteText("blank.mha", header + "Comment = x\n\nElementDataFile = LOCAL\na") },
                       { "blank.mha", "1 bytes of pixels, expected 2" });
  const FrameList list = OpenFrames({ WriteText("skip.mha", header + "HeaderSize = -1\nElementDataFile = LOCAL\nab") });
  EXPECT_EQ(list.frames, 2u);
}

} // namespace
