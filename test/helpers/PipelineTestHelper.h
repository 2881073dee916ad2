// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_PipelineTestHelper_h
#define sensornoise_test_PipelineTestHelper_h

#include "sensornoise/Simulator.h"
#include "itkImage.h"
#include "itkImageAlgorithm.h"
#include "itkImageFileWriter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkImageSource.h"
#include "itkSensorNoiseStackSource.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace sensornoisetest
{
using FrameType = itk::Image<double, 2>;
using MaskType = itk::Image<unsigned char, 2>;

/** Returns the error of an update, or of the function. */
template <typename TFunction>
std::string
ErrorWhen(const TFunction & function)
{
  try
  {
    function();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return "no error";
}

template <typename TProcess>
std::string
ErrorOf(const TProcess & process)
{
  return ErrorWhen([&] { process->Update(); });
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/** Returns an image of the given size with the pixels \a valueOf(index). */
template <typename TImage, typename TFunction>
typename TImage::Pointer
ImageOf(const typename TImage::SizeType &  size,
        const TFunction &                  valueOf,
        const typename TImage::IndexType & start = typename TImage::IndexType{ {} })
{
  auto image = TImage::New();
  image->SetRegions(typename TImage::RegionType(start, size));
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<TImage> it(image, image->GetLargestPossibleRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<typename TImage::PixelType>(valueOf(it.GetIndex())));
  }
  return image;
}

template <typename TImage>
typename TImage::Pointer
ConstantImage(const typename TImage::SizeType & size, double value)
{
  return ImageOf<TImage>(size, [value](const auto &) { return value; });
}

/** Returns the image at another start index. */
template <typename TImage>
typename TImage::Pointer
MovedTo(const typename TImage::IndexType & start, const TImage * image)
{
  auto moved = TImage::New();
  moved->SetRegions(typename TImage::RegionType(start, image->GetLargestPossibleRegion().GetSize()));
  moved->Allocate();
  std::copy_n(
    image->GetBufferPointer(), image->GetLargestPossibleRegion().GetNumberOfPixels(), moved->GetBufferPointer());
  return moved;
}

template <typename TImage>
std::vector<typename TImage::PixelType>
PixelsOf(const TImage * image)
{
  EXPECT_EQ(image->GetBufferedRegion(), image->GetLargestPossibleRegion());
  const auto * const buffer = image->GetBufferPointer();
  return { buffer, buffer + image->GetBufferedRegion().GetNumberOfPixels() };
}

/** Compares bit by bit, so that NaN equals NaN. */
template <typename TPixel>
bool
HaveTheSameBits(const std::vector<TPixel> & a, const std::vector<TPixel> & b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(TPixel)) == 0;
}

template <typename TImage>
bool
HaveTheSameBits(const TImage * a, const TImage * b)
{
  return HaveTheSameBits(PixelsOf(a), PixelsOf(b));
}

/** Returns a source that simulates \a frames frames of the target scene with camera B, a flicker of 5 % and no
 * vibration. */
template <typename TStack>
typename itk::SensorNoiseStackSource<TStack>::Pointer
TargetSource(unsigned int width, unsigned int height, unsigned int frames)
{
  const auto scene = sensornoise::MakeTargetScene(width, height);
  auto       source = itk::SensorNoiseStackSource<TStack>::New();
  source->SetReference(ImageOf<FrameType>({ { width, height } }, [&](const auto & index) {
    return scene[static_cast<std::size_t>(index[1]) * width + static_cast<std::size_t>(index[0])];
  }));
  source->SetNumberOfFrames(frames);
  source->SetVibrationSdX(0.0);
  source->SetVibrationSdY(0.0);
  if (sizeof(typename TStack::PixelType) == 1)
  {
    source->SetElectrons(200.0);
    source->SetOffset(20.0);
    source->SetReadNoise(2.0);
  }
  return source;
}

template <typename TStack>
typename TStack::Pointer
TargetStack(unsigned int width, unsigned int height, unsigned int frames)
{
  const auto               source = TargetSource<TStack>(width, height, frames);
  typename TStack::Pointer stack = source->GetOutput();
  source->Update();
  stack->DisconnectPipeline();
  return stack;
}

/** Gives the frames of a stack as a file reader does, notes what was read, and fails where a frame is broken. */
template <typename TStack>
class StackReader : public itk::ImageSource<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(StackReader);
  using Self = StackReader;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  static Pointer
  Of(const TStack * stack)
  {
    auto reader = Self::New();
    reader->m_Stack = stack;
    return reader;
  }
  void
  Break(itk::IndexValueType frame)
  {
    m_BrokenFrame = frame;
    this->Modified();
  }
  void
  Mend()
  {
    this->Break(-1);
  }
  /** Returns how often frames, or the whole stack, were read. */
  unsigned int
  Reads() const
  {
    return m_Reads;
  }
  unsigned int
  WholeReads() const
  {
    return m_WholeReads;
  }

protected:
  StackReader() = default;
  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->CopyInformation(m_Stack);
  }
  void
  GenerateData() override
  {
    this->AllocateOutputs();
    const auto region = this->GetOutput()->GetRequestedRegion();
    const auto first = region.GetIndex(2) - m_Stack->GetLargestPossibleRegion().GetIndex(2);
    if (m_BrokenFrame >= first && m_BrokenFrame < first + static_cast<itk::IndexValueType>(region.GetSize(2)))
    {
      itkExceptionMacro("frame " << m_BrokenFrame << " is broken");
    }
    itk::ImageAlgorithm::Copy(m_Stack.GetPointer(), this->GetOutput(), region, region);
    ++m_Reads;
    m_WholeReads += region == m_Stack->GetLargestPossibleRegion() ? 1 : 0;
  }

private:
  typename TStack::ConstPointer m_Stack;
  itk::IndexValueType           m_BrokenFrame{ -1 };
  unsigned int                  m_Reads{ 0 };
  unsigned int                  m_WholeReads{ 0 };
};

/** A folder for the files of one test, gone with it. */
class TemporaryFolder
{
public:
  TemporaryFolder()
    : m_Path(std::filesystem::temp_directory_path() /
             ("sensor-noise-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
              std::to_string(::testing::UnitTest::GetInstance()->start_timestamp())))
  {
    std::filesystem::create_directories(m_Path);
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_Path, ignored);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  std::string
  File(const std::string & name) const
  {
    return (m_Path / name).string();
  }

private:
  std::filesystem::path m_Path;
};

template <typename TImage>
std::string
WrittenTo(const std::string & name, const TImage * image)
{
  auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetInput(image);
  writer->SetFileName(name);
  writer->Update();
  return name;
}

} // namespace sensornoisetest

#endif
