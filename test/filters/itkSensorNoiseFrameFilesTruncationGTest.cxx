// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFilesTestHelper.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoisetest::files;

/** Files that were cut off, or that have changed since they were opened. */
class SensorNoiseFrameFilesTruncation : public FrameFilesTest
{};

/** Cuts `cut` off at every length; whatever can still be read must be all that was written. */
void
AnyTruncationIsNoticed(const std::vector<std::string> & files, const std::string & cut)
{
  SCOPED_TRACE(cut);
  ReadsWhatWasWritten<unsigned short>(files, files.size() == 1);
  const std::size_t size = fs::file_size(cut);
  const std::string name = files.size() == 1 ? files.front() : cut;
  std::size_t       refused = 0;
  for (std::size_t length = size - 1; length > 0; --length)
  {
    fs::resize_file(cut, length);
    try
    {
      const auto reader = MakeSource<unsigned short>(files);
      reader->Update();
      ASSERT_EQ(reader->GetFrameList().frames, frames) << length << " of " << size << " bytes";
      ASSERT_EQ(WrongPixels<unsigned short>(reader->GetOutput()), 0u) << length << " of " << size << " bytes";
    }
    catch (const itk::ExceptionObject & error)
    {
      ++refused;
      ExpectParts(error.GetDescription(), { name });
    }
  }
  EXPECT_GT(refused, size / 2);
}

TEST_F(SensorNoiseFrameFilesTruncation, AnyTruncationOfAStackIsNoticed)
{
  for (const bool compress : { false, true })
  {
    for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
    {
      const std::string file = WriteStack<unsigned short>(name, compress);
      AnyTruncationIsNoticed({ file }, file);
    }
    AnyTruncationIsNoticed({ WriteStack<unsigned short>("s.mhd", compress) }, Path(compress ? "s.zraw" : "s.raw"));
    AnyTruncationIsNoticed({ WriteStack<unsigned short>("s.nhdr", compress) }, Path(compress ? "s.raw.gz" : "s.raw"));
  }
}

TEST_F(SensorNoiseFrameFilesTruncation, AnyTruncationOfAFrameOrAHeaderIsNoticed)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    AnyTruncationIsNoticed(files, files[2]);
  }
  const std::string header = WriteStack<unsigned short>("s.mhd");
  AnyTruncationIsNoticed({ header }, header);
}

TEST_F(SensorNoiseFrameFilesTruncation, ATruncatedStackIsRefusedBeforeItIsRead)
{
  for (const std::string name : { "s.mha", "s.nrrd" })
  {
    const std::string file = WriteStack<unsigned short>(name);
    CutOff(file, 1);
    OpeningIsRefusedWith({ file }, { name, "truncated: 279 bytes", "expected 280" });
  }
  for (const std::string name : { "s.mhd", "s.nhdr" })
  {
    const std::string file = WriteStack<unsigned short>(name);
    CutOff(Path("s.raw"), 3);
    OpeningIsRefusedWith({ file }, { name, "s.raw", "truncated: 277 bytes", "expected 280" });
    fs::remove(Path("s.raw"));
    OpeningIsRefusedWith({ file }, { name, "s.raw", "does not exist" });
  }
  const std::string compressed = WriteStack<unsigned short>("c.mha", true);
  CutOff(compressed, 1);
  OpeningIsRefusedWith({ compressed }, { "c.mha", "truncated", "expected" });
  const std::string tiff = WriteStack<unsigned short>("s.tif");
  fs::resize_file(tiff, fs::file_size(tiff) * 3 / 5);
  OpeningIsRefusedWith({ tiff }, { "s.tif, page 2: truncated" });
}

TEST_F(SensorNoiseFrameFilesTruncation, ATruncatedFileAmongGoodOnesIsRefused)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    fs::resize_file(files[2], extension == ".tif" ? 70 : fs::file_size(files[2]) - 1);
    OpeningIsRefusedWith(files, { "frame_2" + extension });
  }
  OpeningIsRefusedWith({ WriteText("other.vtk", "# vtk DataFile Version 3.0\n") },
                       { "other.vtk", "cannot be checked" });
}

TEST_F(SensorNoiseFrameFilesTruncation, AChangeAfterOpeningIsNoticed)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    const FrameList                list = OpenFrames(files);
    const std::string              name = "frame_2" + extension;
    EXPECT_EQ(ErrorOfReading<unsigned short>(list), "no error");

    // a file of the same size with other pixels
    fs::copy_file(files[0], files[2], fs::copy_options::overwrite_existing);
    MakeLater(files[2]);
    ExpectParts(ErrorOfReading<unsigned short>(list), { name, "changed" });
    CutOff(files[2], 1);
    ExpectParts(ErrorOfReading<unsigned short>(list), { name, "changed" });
    fs::remove(files[2]);
    ExpectParts(ErrorOfReading<unsigned short>(list), { name });
  }
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    const std::string file = WriteStack<unsigned short>(name);
    const FrameList   list = OpenFrames({ file });
    EXPECT_EQ(ErrorOfReading<unsigned short>(list), "no error");
    WriteStack<short>(name);
    ExpectParts(ErrorOfReading<unsigned short>(list), { name, "changed" });
  }
  WriteStack<unsigned short>("s.mhd");
  const FrameList list = OpenFrames({ Path("s.mhd") });
  WriteStack<unsigned short>("other.mhd");
  fs::rename(Path("other.raw"), Path("s.raw"));
  ExpectParts(ErrorOfReading<unsigned short>(list), { "s.mhd", "changed" });
}

} // namespace
