/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "helpers/FrameInputTestHelper.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise::test;
using sensornoise::tools::FrameInput;
using sensornoise::tools::MakeReader;
using sensornoise::tools::OpenFrames;

/** What is read is what was written. */
class FrameInputTool : public FrameInputTest
{};

TEST_F(FrameInputTool, AListReadsWhatWasWritten)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    ReadsWhatWasWritten<unsigned short>(WriteList<unsigned short>(extension), false, true);
    ReadsWhatWasWritten<unsigned char>(WriteList<unsigned char>(extension), false, true);
  }
  ReadsWhatWasWritten<short>(WriteList<short>(".tif"), false, true);
  ReadsWhatWasWritten<float>(WriteList<float>(".tif"), false, true);
  ReadsWhatWasWritten<double>(WriteList<double>(".mha"), false, true);
}

TEST_F(FrameInputTool, AStackReadsWhatWasWritten)
{
  for (const bool compress : { false, true })
  {
    ReadsWhatWasWritten<unsigned short>({ WriteStack<unsigned short>("s.mha", compress) }, true, !compress);
    ReadsWhatWasWritten<short>({ WriteStack<short>("s.mhd", compress) }, true, !compress);
    ReadsWhatWasWritten<float>({ WriteStack<float>("s.nrrd", compress) }, true, false);
    ReadsWhatWasWritten<double>({ WriteStack<double>("s.nhdr", compress) }, true, false);
    ReadsWhatWasWritten<unsigned char>({ WriteStack<unsigned char>("s.tif", compress) }, true, false);
    ReadsWhatWasWritten<float>({ WriteStack<float>("s.tif", compress) }, true, false);
  }
}

TEST_F(FrameInputTool, AListOfSlicesOfThreeDimensionsReadsWhatWasWritten)
{
  std::vector<std::string> files;
  for (std::size_t t = 0; t < frames; ++t)
  {
    files.push_back(Write<short, 3>("slice_" + std::to_string(t) + ".mha", { { width, height, 1 } }, t));
  }
  ReadsWhatWasWritten<short>(files, false, true);
}

// ImageSeriesReader would put images of height 1 below each other and images of one pixel beside each other.
TEST_F(FrameInputTool, TimeIsTheLastAxisHoweverSmallTheFramesAre)
{
  for (const itk::Size<2> size :
       { itk::Size<2>{ { 1, 1 } }, itk::Size<2>{ { width, 1 } }, itk::Size<2>{ { 1, height } } })
  {
    for (const std::string extension : { ".tif", ".png", ".mha" })
    {
      std::vector<std::string> files;
      for (std::size_t t = 0; t < frames; ++t)
      {
        files.push_back(WriteFrame<unsigned short>("small_" + std::to_string(t) + extension, t, size));
      }
      const itk::ImageSource<itk::Image<unsigned short, 3>>::Pointer reader =
        MakeReader<unsigned short>(OpenFrames(files));
      reader->Update();
      EXPECT_EQ(reader->GetOutput()->GetBufferedRegion().GetSize(), (itk::Size<3>{ { size[0], size[1], frames } }));
      EXPECT_EQ(WrongPixels<unsigned short>(reader->GetOutput()), 0u);
    }
  }
  const FrameInput one = OpenFrames({ WriteFrame<unsigned char>("one.png") });
  EXPECT_EQ(one.frames, 1u);
  EXPECT_FALSE(one.isStack);
}

TEST_F(FrameInputTool, AListOfDataFilesReadsWhatWasWrittenAndIsChecked)
{
  const std::string stack = WriteStack<unsigned short>("s.mhd");
  std::ifstream     raw(Path("s.raw"), std::ios::binary);
  std::string       header = "NDims = 3\nDimSize = 7 5 4\nElementType = MET_USHORT\nElementDataFile = LIST\n";
  for (std::size_t t = 0; t < frames; ++t)
  {
    std::string pixels(width * height * 2, ' ');
    raw.read(pixels.data(), pixels.size());
    WriteText("part" + std::to_string(t), pixels);
    header += "part" + std::to_string(t) + "\n";
  }
  const std::string list = WriteText("list.mhd", header);
  ReadsWhatWasWritten<unsigned short>({ list }, true, true);
  CutOff(Path("part2"), 1);
  OpeningIsRefusedWith({ list }, { "list.mhd", "part2", "69 bytes", "expected 70" });
  fs::remove(Path("part2"));
  OpeningIsRefusedWith({ list }, { "list.mhd", "part2", "does not exist" });
  OpeningIsRefusedWith({ WriteText("short.mhd", header.substr(0, header.size() - 1)) },
                       { "short.mhd", "3 whole lines", "expected 4" });
}

TEST_F(FrameInputTool, AReaderDoesNotConvert)
{
  const FrameInput input = OpenFrames({ WriteFrame<unsigned short>("frame.tif") });
  ExpectParts(MessageOf([&] { Read<float>(input); }), { "frame.tif", "unsigned_short", "float" });
}

} // namespace
