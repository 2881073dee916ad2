// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFileTestHelper.h"
#include "files/FileBytes.h"
#include "helpers/PngTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>
#if defined(__unix__) || defined(__APPLE__)
#  include <sys/stat.h>
#  include <unistd.h>
#endif

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise;
using namespace sensornoise::test;

class FrameFileInspection : public FrameFileTest
{
protected:
  static std::string
  Said(const std::string & file)
  {
    try
    {
      InspectFrameFile(file);
      return "";
    }
    catch (const FileError & error)
    {
      return error.what();
    }
  }

  static std::string
  SaidOfChange(const FrameFile & file)
  {
    try
    {
      RequireUnchanged(file);
      return "";
    }
    catch (const FileError & error)
    {
      return error.what();
    }
  }
};

TEST_F(FrameFileInspection, WhatIsNoRegularFileIsRefusedUnopened)
{
  const auto isRefused = [](const std::string & file, const std::string & words) {
    EXPECT_EQ(Said(file), file + ": " + words);
  };
  isRefused(Path("missing.tif"), "does not exist; expected an image file");
  isRefused(m_Folder.string(), "is a folder; expected an image file");
  isRefused(Write("empty.tif", ""), "has 0 bytes; expected an image file");
#if defined(__unix__) || defined(__APPLE__)
  ASSERT_EQ(mkfifo(Path("pipe.tif").c_str(), 0600), 0);
  isRefused(Path("pipe.tif"), "is a pipe, a socket or a device; expected an image file");
  isRefused("/dev/zero", "is a pipe, a socket or a device; expected an image file");
  fs::create_symlink(Path("pipe.tif"), Path("link.tif"));
  isRefused(Path("link.tif"), "is a pipe, a socket or a device; expected an image file");
  if (geteuid() != 0)
  {
    ASSERT_EQ(chmod(Write("closed.tif", "a").c_str(), 0), 0);
    isRefused(Path("closed.tif"), "cannot be opened; expected a file that may be read");
    fs::create_directories(Path("closed"));
    Write("closed/a.tif", "a");
    ASSERT_EQ(chmod(Path("closed").c_str(), 0), 0);
    isRefused(Path("closed/a.tif"), "cannot be looked up (Permission denied); expected an image file");
    ASSERT_EQ(chmod(Path("closed").c_str(), 0700), 0);
  }
  const std::string pipeAsData = "NDims = 2\nDimSize = 1 1\nElementType = MET_UCHAR\nElementDataFile = pipe.tif\n";
  IsRefused("a.mhd", pipeAsData, { "its data file " + Path("pipe.tif") + ": is a pipe" });
#endif
}

TEST_F(FrameFileInspection, FormatsThatCannotBeCheckedAreRefusedByName)
{
  const std::string expected = "; expected camera raw, TIFF, PNG, MetaImage, NRRD, SER, MRAW, FITS, NPY or PGM";
  IsRefused("a.jpg", "\xFF\xD8\xFF\xE0 and so on", { "a JPEG file, which cannot be checked" + expected });
  IsRefused("a.bmp", "BM and so on", { "a BMP file" });
  IsRefused("a.vtk", "# vtk DataFile Version 3.0\n", { "a VTK file" });
  IsRefused("a.nii", std::string(344, '\0') + "n+1", { "a NIfTI file" });
  IsRefused("a.dcm", std::string(128, '\0') + "DICM", { "a DICOM file" });
  IsRefused("a.nii.gz", "\x1F\x8B\x08", { "a file of gzip" });
  IsRefused("a.tif", "Dear reader,\nthis is no image.\n", { "no image in a format that can be checked, or damaged" });
  IsRefused("a.mha", std::string(100, '\0'), { "no MetaImage, or damaged at its start" + expected });
  IsRefused("a.mha", "x", { "no MetaImage" });
}

// Whatever its name: ITK goes by the contents, too.
TEST_F(FrameFileInspection, GoesByTheContents)
{
  EXPECT_STREQ(IsFrames("a.tif", PngOf{}.Bytes(), FramePixel::UnsignedShort, 13, 9, 1).format->name, "PNG");
  EXPECT_STREQ(IsFrames("a.mha", TiffOf{}.Bytes(), FramePixel::UnsignedShort, 13, 9, 3).format->name, "TIFF");
}

TEST_F(FrameFileInspection, AnyChangeOfAFileIsNoticed)
{
  const std::string bytes = TiffOf{}.Bytes();
  const auto        fresh = [this, &bytes] { return InspectFrameFile(Write("a.tif", bytes)); };
  FrameFile         file = fresh();
  EXPECT_EQ(SaidOfChange(file), "");
  // the same bytes again, written over the old ones; the clock of a file system may be coarse
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::fstream(file.name, std::ios::binary | std::ios::in | std::ios::out) << bytes;
  EXPECT_EQ(SaidOfChange(file),
            file.name + ": has changed since it was opened; found " + std::to_string(bytes.size()) +
              " bytes, expected the " + std::to_string(bytes.size()) + " bytes of then");
  file = fresh();
  // the time of the contents set back: the time of the status shows it
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto time = fs::last_write_time(file.name);
  std::fstream(file.name, std::ios::binary | std::ios::in | std::ios::out) << bytes;
  fs::last_write_time(file.name, time);
#if defined(__unix__) || defined(__APPLE__)
  EXPECT_NE(SaidOfChange(file), "");
#endif
  file = fresh();
  fs::rename(Write("b.tif", bytes), file.name);
  EXPECT_NE(SaidOfChange(file).find("found another file of that name"), std::string::npos);
  file = fresh();
  fs::resize_file(file.name, bytes.size() - 1);
  EXPECT_NE(SaidOfChange(file).find("found " + std::to_string(bytes.size() - 1) + " bytes"), std::string::npos);
  fs::remove(file.name);
  EXPECT_EQ(SaidOfChange(file), file.name + ": does not exist; expected an image file");
}

TEST_F(FrameFileInspection, AChangeOfADataFileIsNoticed)
{
  Write("a.raw", "ab");
  const std::string header = "NDims = 2\nDimSize = 2 1\nElementType = MET_UCHAR\nElementDataFile = a.raw\n";
  const FrameFile   file = InspectFrameFile(Write("a.mhd", header));
  EXPECT_EQ(SaidOfChange(file), "");
  Write("a.raw", "abc");
  EXPECT_EQ(SaidOfChange(file).rfind(file.name + ": its data file " + Path("a.raw") + " has changed since", 0), 0u);
}

TEST_F(FrameFileInspection, AFileIsTheSameByAllOfItsNames)
{
  const std::string file = Write("a.tif", "a");
  fs::create_symlink(file, Path("link"));
  fs::create_hard_link(file, Path("hard"));
  EXPECT_TRUE(AreSameFile(IdentityOf(file), IdentityOf(Path("link"))));
  EXPECT_TRUE(AreSameFile(IdentityOf(file), IdentityOf(Path("hard"))));
  EXPECT_TRUE(AreSameFile(IdentityOf(file), IdentityOf(Path("./a.tif"))));
  EXPECT_FALSE(AreSameFile(IdentityOf(file), IdentityOf(Write("b.tif", "a"))));
}

TEST_F(FrameFileInspection, DeclaredFramesAreReportedBeforeInflation)
{
  struct TooMuch
  {};
  PngOf png;
  png.width = 1000000;
  png.height = 1000000;
  png.rows = "a";
  const auto refuse = [](const FrameFile & file) {
    if (file.bytes > 1000000)
    {
      throw TooMuch{};
    }
  };
  EXPECT_THROW(InspectFrameFile(Write("a.png", png.Bytes()), refuse), TooMuch);
  EXPECT_NO_THROW(InspectFrameFile(Write("b.png", PngOf{}.Bytes()), refuse));
  TiffOf tiff;
  tiff.compression = 8;
  std::vector<std::uint64_t> bytes;
  InspectFrameFile(Write("a.tif", tiff.Bytes()), [&bytes](const FrameFile & file) { bytes.push_back(file.bytes); });
  EXPECT_EQ(bytes, (std::vector<std::uint64_t>{ 234, 468, 702 }));
  for (const std::string last : { "CompressedData = True\nCompressedDataSize = 1\nElementDataFile = LOCAL\na" })
  {
    const std::string header = "NDims = 2\nDimSize = 99999 99999\nElementType = MET_UCHAR\n" + last;
    EXPECT_THROW(InspectFrameFile(Write("a.mha", header), refuse), TooMuch);
  }
  const std::string nrrd = "NRRD0001\ntype: uchar\ndimension: 2\nsizes: 99999 99999\nencoding: gzip\n\na";
  EXPECT_THROW(InspectFrameFile(Write("a.nrrd", nrrd), refuse), TooMuch);
}

} // namespace
