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
#include "input/FrameInput.h"
#include "itkImageFileWriter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkRGBPixel.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using sensornoise::tools::FrameInput;
using sensornoise::tools::InputError;
using sensornoise::tools::MakeReader;
using sensornoise::tools::OpenFrames;

// All different, so that no axis can be taken for another.
constexpr std::size_t width = 7;
constexpr std::size_t height = 5;
constexpr std::size_t frames = 4;

/** Different in every place of the stack, without symmetry, never 0, which readers fill in. */
template <typename TPixel>
TPixel
ValueAt(std::size_t x, std::size_t y, std::size_t t)
{
  return static_cast<TPixel>(1 + x + width * (y + height * t));
}

class FrameInputTool : public testing::Test
{
protected:
  void
  SetUp() override
  {
    itk::Object::GlobalWarningDisplayOff();
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    // two builds may be tested at the same time
    m_Folder = fs::path(testing::TempDir()) / ("FrameInputTool" + test + std::to_string(std::random_device{}()));
    fs::create_directories(m_Folder);
  }
  void
  TearDown() override
  {
    fs::remove_all(m_Folder);
  }

  std::string
  Path(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  template <typename TPixel, unsigned int VDimension>
  std::string
  Write(const std::string & name, itk::Size<VDimension> size, std::size_t firstFrame = 0, bool compress = false) const
  {
    using ImageType = itk::Image<TPixel, VDimension>;
    const typename ImageType::Pointer image = ImageType::New();
    image->SetRegions(size);
    image->Allocate();
    itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetLargestPossibleRegion());
    for (; !it.IsAtEnd(); ++it)
    {
      const std::size_t t = VDimension == 3 ? it.GetIndex()[VDimension - 1] : 0;
      if constexpr (std::is_arithmetic_v<TPixel>)
      {
        it.Set(ValueAt<TPixel>(it.GetIndex()[0], it.GetIndex()[1], firstFrame + t));
      }
      else
      {
        it.Set(TPixel(9));
      }
    }
    using WriterType = itk::ImageFileWriter<ImageType>;
    const typename WriterType::Pointer writer = WriterType::New();
    writer->SetFileName(Path(name));
    writer->SetInput(image);
    writer->SetUseCompression(compress);
    writer->Update();
    return Path(name);
  }

  template <typename TPixel>
  std::string
  WriteStack(const std::string & name, bool compress = false) const
  {
    return Write<TPixel, 3>(name, { { width, height, frames } }, 0, compress);
  }

  template <typename TPixel>
  std::string
  WriteFrame(const std::string & name, std::size_t t = 0, itk::Size<2> size = { { width, height } }) const
  {
    return Write<TPixel, 2>(name, size, t);
  }

  template <typename TPixel>
  std::vector<std::string>
  WriteList(const std::string & extension) const
  {
    std::vector<std::string> files;
    for (std::size_t t = 0; t < frames; ++t)
    {
      files.push_back(WriteFrame<TPixel>("frame_" + std::to_string(t) + extension, t));
    }
    return files;
  }

  std::string
  WriteText(const std::string & name, const std::string & text) const
  {
    std::ofstream(Path(name), std::ios::binary) << text;
    return Path(name);
  }

  fs::path m_Folder;
};

void
CutOff(const std::string & file, std::size_t bytes)
{
  fs::resize_file(file, fs::file_size(file) - bytes);
}

std::string
MessageOf(const std::function<void()> & action)
{
  try
  {
    action();
  }
  catch (const InputError & error)
  {
    return error.what();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return "no error";
}

void
ExpectParts(const std::string & message, const std::vector<std::string> & parts)
{
  for (const std::string & part : parts)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
}

void
OpeningIsRefusedWith(const std::vector<std::string> & files, const std::vector<std::string> & parts)
{
  ExpectParts(MessageOf([&] { OpenFrames(files); }), parts);
}

template <typename TPixel>
void
Read(const FrameInput & input)
{
  MakeReader<TPixel>(input)->Update();
}

/** The number of pixels in the buffer that are not what was written. */
template <typename TPixel>
std::size_t
WrongPixels(const itk::Image<TPixel, 3> * image)
{
  std::size_t                                                   wrong = 0;
  itk::ImageRegionConstIteratorWithIndex<itk::Image<TPixel, 3>> it(image, image->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    const itk::Index<3> index = it.GetIndex();
    wrong += it.Get() != ValueAt<TPixel>(index[0], index[1], index[2]) ? 1 : 0;
  }
  return wrong;
}

template <typename TPixel>
void
ReadsWhatWasWritten(const std::vector<std::string> & files, bool isStack, bool streams)
{
  SCOPED_TRACE(files.front());
  const FrameInput input = OpenFrames(files);
  EXPECT_EQ(input.files, files);
  EXPECT_EQ(input.isStack, isStack);
  EXPECT_EQ(input.streams, streams);
  EXPECT_EQ(input.component, itk::ImageIOBase::MapPixelType<TPixel>::CType);
  EXPECT_EQ(input.width, width);
  EXPECT_EQ(input.height, height);
  EXPECT_EQ(input.frames, frames);
  EXPECT_EQ(input.bytes, width * height * frames * sizeof(TPixel));
  for (const std::size_t chunks : { std::size_t{ 1 }, std::size_t{ 3 }, frames })
  {
    const typename itk::ImageSource<itk::Image<TPixel, 3>>::Pointer reader = MakeReader<TPixel>(input);
    reader->UpdateOutputInformation();
    itk::ImageRegion<3> region = reader->GetOutput()->GetLargestPossibleRegion();
    ASSERT_EQ(region.GetSize(), (itk::Size<3>{ { width, height, frames } }));
    for (std::size_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::size_t first = chunk * frames / chunks;
      const std::size_t end = (chunk + 1) * frames / chunks;
      region.SetIndex(2, first);
      region.SetSize(2, end - first);
      reader->GetOutput()->SetRequestedRegion(region);
      reader->GetOutput()->Update();
      ASSERT_TRUE(reader->GetOutput()->GetBufferedRegion().IsInside(region));
      EXPECT_EQ(reader->GetOutput()->GetBufferedRegion().GetSize(2), streams ? end - first : frames);
      EXPECT_EQ(WrongPixels<TPixel>(reader->GetOutput()), 0u);
    }
  }
}

/** Cuts `cut` off at every length; whatever can still be read must be all that was written. */
void
AnyTruncationIsNoticed(const std::vector<std::string> & files, const std::string & cut)
{
  SCOPED_TRACE(cut);
  ReadsWhatWasWritten<unsigned short>(files, files.size() == 1, OpenFrames(files).streams);
  const std::size_t size = fs::file_size(cut);
  const std::string name = (files.size() == 1 ? files.front() : cut) + ": ";
  std::size_t       refused = 0;
  for (std::size_t length = size - 1; length > 0; --length)
  {
    fs::resize_file(cut, length);
    try
    {
      const FrameInput                                               input = OpenFrames(files);
      const itk::ImageSource<itk::Image<unsigned short, 3>>::Pointer reader = MakeReader<unsigned short>(input);
      reader->Update();
      ASSERT_EQ(input.frames, frames) << length << " of " << size << " bytes";
      ASSERT_EQ(WrongPixels<unsigned short>(reader->GetOutput()), 0u) << length << " of " << size << " bytes";
    }
    catch (const InputError & error)
    {
      ++refused;
      ExpectParts(error.what(), { name });
    }
    catch (const itk::ExceptionObject & error)
    {
      ++refused;
      ExpectParts(error.GetDescription(), { name });
    }
  }
  EXPECT_GT(refused, size / 2);
}

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

TEST_F(FrameInputTool, AnyTruncationOfAStackIsNoticed)
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

TEST_F(FrameInputTool, AnyTruncationOfAFrameOrAHeaderIsNoticed)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    AnyTruncationIsNoticed(files, files[2]);
  }
  const std::string header = WriteStack<unsigned short>("s.mhd");
  AnyTruncationIsNoticed({ header }, header);
}

TEST_F(FrameInputTool, ATruncatedStackIsRefusedBeforeItIsRead)
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
    OpeningIsRefusedWith({ file }, { name, "s.raw", name == "s.mhd" ? "does not exist" : "couldn't open" });
  }
  const std::string compressed = WriteStack<unsigned short>("c.mha", true);
  CutOff(compressed, 1);
  OpeningIsRefusedWith({ compressed }, { "c.mha", "truncated", "expected" });
  const std::string tiff = WriteStack<unsigned short>("s.tif");
  fs::resize_file(tiff, fs::file_size(tiff) * 3 / 5);
  OpeningIsRefusedWith({ tiff },
                       { "s.tif", "truncated: 2 of its pages can be read, but the file says that more follow" });
}

TEST_F(FrameInputTool, ATruncatedFileAmongGoodOnesIsRefused)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    fs::resize_file(files[2], extension == ".tif" ? 70 : fs::file_size(files[2]) - 1);
    OpeningIsRefusedWith(files, { "frame_2" + extension });
  }
  const std::string other = WriteFrame<unsigned short>("other.vtk", 0, { { 64, 48 } });
  EXPECT_EQ(OpenFrames({ other }).width, 64u);
  fs::resize_file(other, 5000);
  OpeningIsRefusedWith({ other }, { "other.vtk", "5000 bytes, fewer than the 6144" });
}

TEST_F(FrameInputTool, WhatIsNotAnImageIsRefused)
{
  const std::string good = WriteFrame<unsigned short>("good.tif");
  OpeningIsRefusedWith({}, { "no file was given" });
  OpeningIsRefusedWith({ good, Path("missing.tif") }, { "missing.tif", "does not exist" });
  fs::create_directories(Path("folder.tif"));
  OpeningIsRefusedWith({ good, Path("folder.tif") }, { "folder.tif", "is a folder" });
  OpeningIsRefusedWith({ good, WriteText("empty.tif", "") }, { "empty.tif", "has 0 bytes" });
  OpeningIsRefusedWith({ good, WriteText("text.tif", "Dear reader,\nthis is no image.\n") },
                       { "text.tif", "not an image in a format that ITK reads" });
}

TEST_F(FrameInputTool, ColoursAreRefused)
{
  for (const std::string extension : { ".png", ".tif", ".mha", ".nrrd" })
  {
    const std::string grey = WriteFrame<unsigned char>("grey" + extension);
    const std::string colour = WriteFrame<itk::RGBPixel<unsigned char>>("colour" + extension);
    OpeningIsRefusedWith({ grey, colour }, { "colour" + extension, "3 components a pixel", "expected 1" });
  }
}

TEST_F(FrameInputTool, DifferentSizesAndComponentTypesAreRefused)
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

TEST_F(FrameInputTool, AStackAmongFramesIsRefused)
{
  OpeningIsRefusedWith({ WriteFrame<short>("frame.tif"), WriteStack<short>("stack.tif") },
                       { "stack.tif", "has 4 frames", "2 files" });
}

TEST_F(FrameInputTool, OtherComponentTypesAreRefusedByName)
{
  const std::string expected = "expected unsigned char, unsigned short, short, float or double";
  for (const std::string extension : { ".mha", ".nrrd" })
  {
    OpeningIsRefusedWith({ WriteFrame<int>("i" + extension) }, { "i" + extension, "component type int is", expected });
    OpeningIsRefusedWith({ WriteFrame<unsigned int>("u" + extension) },
                         { "u" + extension, "component type unsigned int is", expected });
    OpeningIsRefusedWith({ WriteFrame<signed char>("c" + extension) },
                         { "c" + extension, "component type char is", expected });
  }
}

TEST_F(FrameInputTool, AReaderDoesNotConvert)
{
  const FrameInput input = OpenFrames({ WriteFrame<unsigned short>("frame.tif") });
  ExpectParts(MessageOf([&] { Read<float>(input); }), { "frame.tif", "unsigned_short", "float" });
}

TEST_F(FrameInputTool, AChangeAfterOpeningIsNoticed)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    const std::vector<std::string> files = WriteList<unsigned short>(extension);
    const FrameInput               input = OpenFrames(files);
    const std::string              name = "frame_2" + extension;

    WriteFrame<unsigned short>(name, 2, { { width - 1, height } });
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }), { name, "now 6 x 5", "expected 7 x 5" });
    WriteFrame<unsigned char>(name, 2);
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }),
                { name, "unsigned char", "expected", "unsigned short" });
    WriteFrame<unsigned short>(name, 2);
    CutOff(files[2], extension == ".tif" ? 200 : 1);
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }), { name });
    fs::remove(files[2]);
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }), { name, "does not exist" });
  }
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    const std::string file = WriteStack<unsigned short>(name);
    const FrameInput  input = OpenFrames({ file });
    WriteStack<float>(name);
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }), { name, "float", "expected", "unsigned short" });
    WriteStack<unsigned short>(name);
    fs::resize_file(file, fs::file_size(file) * 3 / 5);
    ExpectParts(MessageOf([&] { Read<unsigned short>(input); }), { name, "truncated" });
  }
}

/** One entry of a TIFF directory with a single value. */
struct Tag
{
  unsigned int number;
  unsigned int value;
};

/** A little-endian TIFF of pages of 8 x 4 pixels and 128 bytes, with what a page says beyond that or otherwise. */
std::string
TiffWith(const std::vector<std::vector<Tag>> & pages)
{
  std::string bytes;
  const auto  add = [&bytes](std::size_t value, int width) {
    for (; width > 0; --width, value >>= 8)
    {
      bytes += static_cast<char>(value & 255);
    }
  };
  add(0x002A4949, 4);
  add(8, 4);
  for (const std::vector<Tag> & page : pages)
  {
    std::map<unsigned int, unsigned int> tags{
      { 256, 8 }, { 257, 4 }, { 258, 16 }, { 259, 1 }, { 262, 1 }, { 277, 1 }
    };
    for (const Tag & tag : page)
    {
      tags[tag.number] = tag.value;
    }
    const bool        tiled = tags.count(322) != 0;
    const std::size_t end = bytes.size() + 2 + 12 * (tags.size() + 2) + 4;
    tags[tiled ? 324 : 273] = static_cast<unsigned int>(end);
    tags[tiled ? 325 : 279] = 128;
    add(tags.size(), 2);
    for (const auto & [number, value] : tags)
    {
      add(number, 2);
      add(4, 2); // type: 32 bits
      add(1, 4);
      add(value, 4);
    }
    add(&page == &pages.back() ? 0 : end + 128, 4);
    bytes.append(128, '\1');
  }
  return bytes;
}

TEST_F(FrameInputTool, ATiffThatITKWouldConvertIsRefused)
{
  const FrameInput good = OpenFrames({ WriteText("good.tif", TiffWith({ {}, {}, {} })) });
  EXPECT_EQ(good.frames, 3u);
  const auto isRefused = [this](const std::vector<std::vector<Tag>> & pages, const std::vector<std::string> & parts) {
    OpeningIsRefusedWith({ WriteText("page.tif", TiffWith(pages)) }, parts);
  };
  isRefused({ { { 258, 32 } } }, { "page.tif", "component type unsigned int is not supported" });
  isRefused({ { { 258, 32 }, { 339, 2 } } }, { "page.tif", "component type int is not supported" });
  isRefused({ { { 339, 3 } } }, { "page.tif", "16-bit floating-point" });
  isRefused({ { { 258, 4 } } }, { "page.tif", "4-bit unsigned" });
  isRefused({ { { 258, 12 } } }, { "page.tif", "12-bit" });
  isRefused({ { { 322, 16 }, { 323, 16 } } }, { "page.tif", "tiled" });
  isRefused({ {}, { { 256, 4 } } }, { "page.tif, page 1", "4 x 4 pixels", "8 x 4" });
  isRefused({ {}, { { 258, 32 }, { 339, 3 } } }, { "page.tif, page 1", "32-bit floating-point", "unsigned_short" });
  isRefused({ {}, {}, { { 254, 1 } } }, { "page.tif", "pages: 3", "2 frames" });
  isRefused({ { { 257, 40 } } }, { "page.tif", "truncated: its strip 0 is at bytes 110 to 750", "the file has 238" });
}

/** Lets the entry of the first page that stands for a longer value point to that value, at the end of the file. */
std::string
TiffWithValueAtTheEnd(std::string tiff, Tag entry, unsigned int type, unsigned int count, const std::string & value)
{
  const std::string head{ static_cast<char>(entry.number & 255), static_cast<char>(entry.number >> 8), 4, 0 };
  const std::size_t at = tiff.find(head);
  tiff[at + 2] = static_cast<char>(type);
  tiff[at + 4] = static_cast<char>(count & 255);
  tiff[at + 5] = static_cast<char>(count >> 8);
  tiff[at + 8] = static_cast<char>(tiff.size() & 255);
  tiff[at + 9] = static_cast<char>(tiff.size() >> 8);
  return tiff + value;
}

TEST_F(FrameInputTool, ATiffWithPagesOnlyImageJKnowsIsRefused)
{
  const std::string text("ImageJ=1.54\nimages=500\nslices=500\n\0", 35);
  const std::string tiff = TiffWithValueAtTheEnd(TiffWith({ { { 270, 0 } } }), { 270, 0 }, 2, text.size(), text);
  OpeningIsRefusedWith({ WriteText("imagej.tif", tiff) }, { "imagej.tif", "pages: 1", "images=500" });
}

TEST_F(FrameInputTool, ATiffWithAPaletteIsRefused)
{
  // grey, but other greys than the pixels: ITK would read the palette's
  const std::string palette(3 * 256 * 2, '\0');
  const std::string page = TiffWith({ { { 258, 8 }, { 262, 3 }, { 320, 0 } } });
  const std::string tiff = TiffWithValueAtTheEnd(page, { 320, 0 }, 3, 3 * 256, palette);
  OpeningIsRefusedWith({ WriteText("palette.tif", tiff) }, { "palette.tif", "palette of colours" });
}

TEST_F(FrameInputTool, AMetaImageThatCannotBeCheckedIsRefused)
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
  const FrameInput input =
    OpenFrames({ WriteText("skip.mha", header + "HeaderSize = -1\nElementDataFile = LOCAL\nab") });
  EXPECT_EQ(input.frames, 2u);
}

} // namespace
