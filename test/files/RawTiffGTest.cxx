// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/RawCameraFile.h"

#include "helpers/DngTestHelper.h"
#include "helpers/FrameFileTestHelper.h"

#include <string>

// Raw files of cameras that are TIFFs, as far as they are checked without LibRaw.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class RawTiff : public FrameFileTest
{
protected:
  /** Returns the error that the check ends with; "" without one. */
  std::string
  ErrorOf(const std::string & contents, std::uint64_t width, std::uint64_t height) const
  {
    const std::string file = Write("a.dng", contents);
    FileBytes         bytes(file);
    try
    {
      RequireWholeRawTiff(file, bytes, width, height);
      return "";
    }
    catch (const FileError & error)
    {
      return error.what();
    }
  }
};

TEST_F(RawTiff, WithoutADirectoryIsRefused)
{
  const DngOf dng = DngOf::Sound();
  std::string contents = dng.Bytes();
  EXPECT_EQ(ErrorOf(contents, dng.width, dng.height), "");
  contents.replace(4, 4, 4, '\0'); // the place of the first directory
  EXPECT_NE(ErrorOf(contents, dng.width, dng.height).find("damaged: its first directory is at byte 0"),
            std::string::npos);
}
} // namespace
