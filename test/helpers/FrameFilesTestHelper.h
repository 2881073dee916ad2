// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoisetest_FrameFilesTestHelper_h
#define sensornoisetest_FrameFilesTestHelper_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkSensorNoiseFrameListSource.h"
#include "sensornoise/FrameFile.h"
#include "helpers/FolderTestHelper.h"
#include "itkImage.h"
#include "itkImageFileWriter.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <type_traits>
#include <vector>

/** \file
 * Small frames and stacks on files, and the messages of opening and reading them. */

namespace sensornoisetest::files
{
using sensornoise::FrameList;
using sensornoise::OpenFrames;

// All different, so that no axis can be taken for another.
inline constexpr std::size_t width = 7;
inline constexpr std::size_t height = 5;
inline constexpr std::size_t frames = 4;

/** Returns a value that differs between all places of the stack, without symmetry. It is never 0, which readers fill
 * in. */
template <typename TPixel>
TPixel
ValueAt(std::size_t x, std::size_t y, std::size_t t)
{
  return static_cast<TPixel>(1 + x + width * (y + height * t));
}

/** Writes frames and stacks into an empty folder of its own. */
class FrameFilesTest : public sensornoise::test::FolderTest
{
protected:
  void
  SetUp() override
  {
    itk::Object::GlobalWarningDisplayOff();
    FolderTest::SetUp();
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
};

inline void
CutOff(const std::string & file, std::size_t bytes)
{
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - bytes);
}

/** Makes the time of a file one second later. The clock of a file system may be too coarse to distinguish two writings
 * in a test. */
inline void
MakeLater(const std::string & file)
{
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(1));
}

inline std::string
MessageOf(const std::function<void()> & action)
{
  try
  {
    action();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  catch (const std::exception & error)
  {
    return error.what();
  }
  return "no error";
}

inline void
ExpectParts(const std::string & message, const std::vector<std::string> & parts)
{
  for (const std::string & part : parts)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
}

inline void
OpeningIsRefusedWith(const std::vector<std::string> & files, const std::vector<std::string> & parts)
{
  ExpectParts(MessageOf([&] { OpenFrames(files); }), parts);
}

template <typename TPixel>
using SourceOf = itk::SensorNoiseFrameListSource<itk::Image<TPixel, 3>>;

template <typename TPixel>
typename SourceOf<TPixel>::Pointer
MakeSource(const std::vector<std::string> & files)
{
  auto source = SourceOf<TPixel>::New();
  source->SetFileNames(files);
  return source;
}

template <typename TPixel>
typename SourceOf<TPixel>::Pointer
MakeSource(const FrameList & list)
{
  auto source = SourceOf<TPixel>::New();
  source->SetFrameList(list);
  return source;
}

/** Returns the error of reading files that were opened before. */
template <typename TPixel>
std::string
ErrorOfReading(const FrameList & list)
{
  return MessageOf([&] { MakeSource<TPixel>(list)->Update(); });
}

/** Returns a part of the output of a source. */
template <typename TPixel>
const itk::Image<TPixel, 3> *
ReadPart(SourceOf<TPixel> * source, std::size_t first, std::size_t count)
{
  source->UpdateOutputInformation();
  itk::ImageRegion<3> region = source->GetOutput()->GetLargestPossibleRegion();
  region.SetIndex(2, static_cast<itk::IndexValueType>(first));
  region.SetSize(2, count);
  source->GetOutput()->SetRequestedRegion(region);
  source->GetOutput()->Update();
  return source->GetOutput();
}

/** Returns the number of pixels in the buffer that differ from the pixels that were written. */
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
ReadsWhatWasWritten(const std::vector<std::string> & files, bool isStack)
{
  SCOPED_TRACE(files.front());
  const FrameList list = OpenFrames(files);
  EXPECT_EQ(list.Names(), files);
  EXPECT_EQ(list.isStack, isStack);
  EXPECT_EQ(SourceOf<TPixel>::ReadComponentType(files), itk::ImageIOBase::MapPixelType<TPixel>::CType);
  EXPECT_EQ(list.width, width);
  EXPECT_EQ(list.height, height);
  EXPECT_EQ(list.frames, frames);
  EXPECT_EQ(list.bytes, width * height * frames * sizeof(TPixel));
  for (const std::size_t chunks : { std::size_t{ 1 }, std::size_t{ 3 }, frames })
  {
    const auto source = MakeSource<TPixel>(files);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::size_t  first = chunk * frames / chunks;
      const std::size_t  end = (chunk + 1) * frames / chunks;
      const auto * const image = ReadPart<TPixel>(source, first, end - first);
      ASSERT_EQ(image->GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { width, height, frames } }));
      ASSERT_TRUE(image->GetBufferedRegion().IsInside(image->GetRequestedRegion()));
      EXPECT_EQ(image->GetBufferedRegion().GetSize(2), end - first);
      EXPECT_EQ(WrongPixels<TPixel>(image), 0u);
    }
  }
}

} // namespace sensornoisetest::files

#endif
