// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"
#include "itkRGBPixel.h"

#include <cstddef>
#include <string>
#include <vector>

namespace
{

/** Files that cannot be used. */
class EstimateBadInputTool : public EstimateToolTest
{
protected:
  using FrameType = itk::Image<unsigned short, 2>;

  /** Writes eight small frames, in which nothing is wrong but the change of the test. */
  std::vector<std::string>
  WriteSmallList(const std::string & extension) const
  {
    return WriteList<unsigned short>(Make<StackType>({ { 9, 7, 8 } }, 100), extension);
  }
};
} // namespace

TEST_F(EstimateBadInputTool, NoFrameIsRefused)
{
  IsRefused("", { "no FRAME was given; expected image files, a folder or a stack" });
}

TEST_F(EstimateBadInputTool, OneToFourFramesAreRefused)
{
  const auto burst = MakeBurst(5);
  const auto names = WriteList<unsigned short>(burst, ".tif");
  for (std::size_t frames = 1; frames < 5; ++frames)
  {
    const std::string found = "the stack has " + std::to_string(frames) + " frame";
    for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
    {
      Write(name, Cut<unsigned short>(burst, { { 0, 0, 0 } }, { { 64, 64, frames } }).GetPointer());
      IsRefused(name, { found, "expected at least 5", "--method single-image" });
    }
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(frames);
    IsRefused(Joined({ names.begin(), end }), { found, "expected at least 5", "--method single-image" });
  }
  EXPECT_NE(Run(Joined(names)), 2) << m_Message;
}

TEST_F(EstimateBadInputTool, FramesOfDifferentSizesOrTypesAreRefused)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    std::vector<std::string> names = WriteSmallList(extension);
    names[5] = Write<FrameType>("other" + extension, Make<FrameType>({ { 7, 9 } }, 100));
    IsRefused(Joined(names), { names[5], "7 x 9 pixels", names[0] + " has 9 x 7" });
    using ByteType = itk::Image<unsigned char, 2>;
    names[5] = Write<ByteType>("bytes" + extension, Make<ByteType>({ { 9, 7 } }, 100));
    IsRefused(Joined(names), { names[5], "unsigned char", names[0] + " has unsigned short" });
  }
}

TEST_F(EstimateBadInputTool, AColourTruncatedOrMissingFileAmongGoodOnesIsRefused)
{
  using ColourType = itk::Image<itk::RGBPixel<unsigned short>, 2>;
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    std::vector<std::string> names = WriteSmallList(extension);
    // a TIFF file has tags behind its pixels; without some of them it is still complete
    const auto size = std::filesystem::file_size(Path(names[6]));
    std::filesystem::resize_file(Path(names[6]), extension == ".tif" ? size / 3 : size - 20);
    IsRefused(Joined(names), { names[6] });
    std::filesystem::remove(Path(names[6]));
    IsRefused(Joined(names), { names[6], "does not exist", "expected an image file" });
    itk::RGBPixel<unsigned short> grey;
    grey.Fill(100);
    Write<ColourType>(names[6], Make<ColourType>({ { 9, 7 } }, grey));
    IsRefused(Joined(names), { names[6], "3 components a pixel", "expected 1" });
  }
}

TEST_F(EstimateBadInputTool, ATruncatedStackIsRefused)
{
  const auto burst = MakeBurst(8);
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    Write(name, burst.GetPointer());
    std::filesystem::resize_file(Path(name), std::filesystem::file_size(Path(name)) - 8000);
    IsRefused(name, { name, "truncated", name == "s.tif" ? "its pages can be read" : "expected 65536" });
  }
  Write("s.mhd", burst.GetPointer());
  std::filesystem::resize_file(Path("s.raw"), 60000);
  IsRefused("s.mhd", { "s.mhd", "s.raw", "truncated: 60000 bytes", "expected 65536" });
}

TEST_F(EstimateBadInputTool, AFolderATextAndAnEmptyFileAreRefused)
{
  std::filesystem::create_directories(Path("folder.tif"));
  IsRefused("folder.tif", { "folder.tif: there is no file in this folder" });
  IsRefused("s.mha --mask folder.tif", { "s.mha", "does not exist" });
  IsRefused(WriteText("empty.mha", ""), { "empty.mha", "has 0 bytes" });
  IsRefused(WriteText("text.tif", "Dear reader,\nthis is no image.\n"), { "text.tif", "no image in a format" });
  IsRefused("nowhere.mha", { "nowhere.mha", "does not exist" });
}

TEST_F(EstimateBadInputTool, FramesOfOnePixelOrOneRowAreRefused)
{
  for (const itk::Size<3> size : { itk::Size<3>{ { 1, 1, 8 } }, itk::Size<3>{ { 50, 1, 8 } } })
  {
    const std::string found = std::to_string(size[0]) + " x " + std::to_string(size[1]) + " pixels";
    const auto        stack = Make<StackType>(size, 100);
    IsRefused(Write("small.mha", stack.GetPointer()), { found, "expected at least 3 x 3" });
    IsRefused(Joined(WriteList<unsigned short>(stack, ".tif")), { found, "expected at least 3 x 3" });
  }
}

TEST_F(EstimateBadInputTool, DataBeyondTheBitDepthAreRefused)
{
  const auto burst = MakeBurst();
  burst->SetPixel({ { 20, 30, 4 } }, 4000);
  const std::string stack = Write("s.mha", burst.GetPointer());
  IsRefused(stack + " --bit-depth 8", { "the level 4000 DN", "8 bits", "end at 255 DN", "larger bit depth" });
}

TEST_F(EstimateBadInputTool, AMaskThatDoesNotFitIsRefused)
{
  using MaskType = itk::Image<unsigned char, 2>;
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  Write("mask.png", Make<MaskType>({ { 64, 63 } }, 1).GetPointer());
  IsRefused(stack + " --mask mask.png", { "the mask mask.png: has 64 x 63 pixels", "the frames have 64 x 64" });
  IsRefused(stack + " --mask mask.png --roi 0,0,64,63", { "the mask mask.png: has 64 x 63 pixels" });
  IsRefused(stack + " --mask s.mha", { "the mask s.mha: has 24 frames", "expected one image" });
  IsRefused(stack + " --mask nowhere.png", { "nowhere.png", "does not exist" });
}

TEST_F(EstimateBadInputTool, CompressedPixelsThatAreDamagedAreRefused)
{
  const auto burst = MakeBurst();
  const auto writer = itk::ImageFileWriter<StackType>::New();
  writer->SetInput(burst);
  writer->UseCompressionOn();
  writer->SetFileName(Path("s.nrrd").string());
  writer->Update();
  std::fstream file(Path("s.nrrd"), std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(-60000, std::ios::end);
  file << std::string(30000, 'x');
  file.close();
  IsRefused("s.nrrd", { "s.nrrd", "damaged: its compressed pixels" });
}
