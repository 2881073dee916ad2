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
#ifndef FrameInput_h
#define FrameInput_h

#include "input/FileCompleteness.h"

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageSource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The frames that a tool was given, after their headers have been checked: one stack file, or one file per frame. */
struct FrameInput
{
  std::vector<std::string> files;
  bool                     isStack{ false }; // one file with all frames
  itk::IOComponentEnum     component{ itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE };
  std::size_t              width{ 0 };  // pixels
  std::size_t              height{ 0 }; // pixels
  std::size_t              frames{ 0 };
  bool                     streams{ false }; // can be read a few frames at a time
  std::uint64_t            bytes{ 0 };       // of all frames, uncompressed
};

/** Opens the header of every file, reads no pixel, and throws InputError unless all is well: each file exists, is an
 * image in a format that ITK reads, has one component of type unsigned char, unsigned short, short, float or double
 * for each pixel and is complete (CheckFileIsComplete()), and all have the same size and component type. One 3-D file
 * is a stack; a list holds 2-D files, or 3-D files of one slice. */
FrameInput
OpenFrames(const std::vector<std::string> & files);

/** Throws InputError unless the file still is what OpenFrames() found. */
void
CheckUnchanged(const FrameInput & input, const std::string & file);

/** Checks the file of a frame as CheckUnchanged() and reads it. `buffer` has room for width x height pixels. */
void
ReadFrame(const FrameInput & input, std::size_t frame, void * buffer);

/** One sentence about pixels that an ImageIO could not read. */
std::string
PixelErrorOf(const std::string & file, const itk::ExceptionObject & exception);

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
      CheckUnchanged(m_FrameInput, m_FrameInput.files.front());
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

/** The source of the stack (x, y, time). TPixel must be the component type of the files: nothing is converted. */
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

} // namespace sensornoise::tools

#endif
