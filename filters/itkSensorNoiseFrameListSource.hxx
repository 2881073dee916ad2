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
#include "input/FrameReader.h"

#include "input/ErrorText.h"
#include "input/FrameHeader.h"
#include "input/InputError.h"
#include "input/SilentTiff.h"
#include "itkImageFileReader.h"

#include <cstddef>
#include <string>

namespace sensornoise::tools
{
namespace
{
/** The header of a file. Throws InputError unless the file still is what OpenFrames() found. */
itk::ImageIOBase::Pointer
OpenUnchanged(const FrameInput & input, const std::string & file)
{
  const itk::ImageIOBase::Pointer io = OpenHeader(file);
  const FrameInput                found = Describe(file, *io);
  const std::size_t               frames = input.isStack ? input.frames : 1;
  if (found.width != input.width || found.height != input.height || found.frames != frames ||
      found.component != input.component)
  {
    throw InputError(file + ": has changed since it was opened; now " + SizeOf(found.width, found.height) +
                     " pixels, frames: " + std::to_string(found.frames) + ", " + NameOf(found.component) +
                     ", expected " + SizeOf(input.width, input.height) + " pixels, frames: " + std::to_string(frames) +
                     ", " + NameOf(input.component));
  }
  return io;
}

void
CheckStackIsUnchanged(const FrameInput & input)
{
  const SilentTiff silent;
  OpenUnchanged(input, input.files.front());
}

/** Reads the file of a frame. `buffer` has room for width x height pixels. */
void
ReadFrame(const FrameInput & input, std::size_t frame, void * buffer)
{
  const SilentTiff                silent;
  const std::string               file = input.files.at(frame);
  const itk::ImageIOBase::Pointer io = OpenUnchanged(input, file);

  itk::ImageIORegion region(io->GetNumberOfDimensions());
  for (unsigned int i = 0; i < io->GetNumberOfDimensions(); ++i)
  {
    region.SetSize(i, io->GetDimensions(i));
  }
  io->SetIORegion(region);
  try
  {
    io->Read(buffer);
  }
  catch (const itk::ExceptionObject & exception)
  {
    throw InputError(PixelErrorOf(file, exception));
  }
}

/** Frames from a list of files, one at a time, without conversion.
 *
 * Not ImageSeriesReader: that stacks images of height 1 along y instead of time, converts a file whose component type
 * has changed, and believes files that have been cut off since. Streams whole frames. */
template <typename TPixel>
class FrameListSource : public itk::ImageSource<itk::Image<TPixel, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FrameListSource);

  using Self = FrameListSource;
  using Superclass = itk::ImageSource<itk::Image<TPixel, 3>>;
  using Pointer = itk::SmartPointer<Self>;
  using ConstPointer = itk::SmartPointer<const Self>;
  using RegionType = typename itk::Image<TPixel, 3>::RegionType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "FrameListSource";
  }

  void
  SetFrameInput(const FrameInput & input)
  {
    m_FrameInput = input;
    this->Modified();
  }

protected:
  FrameListSource() = default;
  ~FrameListSource() override = default;

  void
  GenerateOutputInformation() override
  {
    const typename RegionType::SizeType size{ { m_FrameInput.width, m_FrameInput.height, m_FrameInput.frames } };
    this->GetOutput()->SetLargestPossibleRegion(RegionType(size));
  }

  void
  EnlargeOutputRequestedRegion(itk::DataObject * output) override
  {
    auto * const image = itkDynamicCastInDebugMode<itk::Image<TPixel, 3> *>(output);
    RegionType   region = image->GetLargestPossibleRegion();
    region.SetIndex(2, image->GetRequestedRegion().GetIndex(2));
    region.SetSize(2, image->GetRequestedRegion().GetSize(2));
    image->SetRequestedRegion(region);
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    const RegionType region = this->GetOutput()->GetRequestedRegion();
    TPixel *         buffer = this->GetOutput()->GetBufferPointer();
    for (std::size_t i = 0; i < region.GetSize(2); ++i)
    {
      try
      {
        ReadFrame(m_FrameInput, region.GetIndex(2) + i, buffer);
      }
      catch (const InputError & error)
      {
        throw itk::ExceptionObject(__FILE__, __LINE__, error.what(), ITK_LOCATION);
      }
      buffer += m_FrameInput.width * m_FrameInput.height;
    }
  }

private:
  FrameInput m_FrameInput{};
};

/** Reads a stack file, and checks before each chunk that the file has not changed since OpenFrames(). */
template <typename TPixel>
class FrameStackReader : public itk::ImageFileReader<itk::Image<TPixel, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FrameStackReader);

  using Self = FrameStackReader;
  using Superclass = itk::ImageFileReader<itk::Image<TPixel, 3>>;
  using Pointer = itk::SmartPointer<Self>;
  using ConstPointer = itk::SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "FrameStackReader";
  }

  void
  SetFrameInput(const FrameInput & input)
  {
    m_FrameInput = input;
    this->SetFileName(input.files.front());
    this->SetUseStreaming(input.streams);
    this->Modified();
  }

protected:
  FrameStackReader() = default;
  ~FrameStackReader() override = default;

  void
  GenerateData() override
  {
    try
    {
      CheckStackIsUnchanged(m_FrameInput);
      Superclass::GenerateData();
    }
    catch (const InputError & error)
    {
      throw itk::ExceptionObject(__FILE__, __LINE__, error.what(), ITK_LOCATION);
    }
    catch (const itk::ExceptionObject & exception)
    {
      throw itk::ExceptionObject(__FILE__, __LINE__, PixelErrorOf(m_FrameInput.files.front(), exception), ITK_LOCATION);
    }
  }

private:
  FrameInput m_FrameInput{};
};
} // namespace

template <typename TPixel>
typename itk::ImageSource<itk::Image<TPixel, 3>>::Pointer
MakeReader(const FrameInput & input)
{
  if (itk::ImageIOBase::MapPixelType<TPixel>::CType != input.component)
  {
    throw InputError(input.files.front() + ": has component type " +
                     itk::ImageIOBase::GetComponentTypeAsString(input.component) + ", but a reader for " +
                     itk::ImageIOBase::GetComponentTypeAsString(itk::ImageIOBase::MapPixelType<TPixel>::CType) +
                     " was asked for");
  }
  if (input.isStack)
  {
    const typename FrameStackReader<TPixel>::Pointer reader = FrameStackReader<TPixel>::New();
    reader->SetFrameInput(input);
    return reader.GetPointer();
  }
  const typename FrameListSource<TPixel>::Pointer source = FrameListSource<TPixel>::New();
  source->SetFrameInput(input);
  return source.GetPointer();
}

template itk::ImageSource<itk::Image<unsigned char, 3>>::Pointer
MakeReader<unsigned char>(const FrameInput &);
template itk::ImageSource<itk::Image<unsigned short, 3>>::Pointer
MakeReader<unsigned short>(const FrameInput &);
template itk::ImageSource<itk::Image<short, 3>>::Pointer
MakeReader<short>(const FrameInput &);
template itk::ImageSource<itk::Image<float, 3>>::Pointer
MakeReader<float>(const FrameInput &);
template itk::ImageSource<itk::Image<double, 3>>::Pointer
MakeReader<double>(const FrameInput &);

} // namespace sensornoise::tools
