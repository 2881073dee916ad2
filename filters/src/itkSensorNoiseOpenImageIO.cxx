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
#include "itkSensorNoiseOpenImageIO.h"

#include "sensornoise/FrameFile.h"
#include "files/FrameFormats.h"
#include "files/StoredNumber.h"
#include "itkObjectFactoryBase.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <string>

namespace sensornoise
{
namespace
{
/** Returns the cause of an exception as text. For an exception of ITK it is the first line without class and address.
 * For a chain of messages of NRRD it is the last message. */
std::string
CauseOf(const std::exception & error)
{
  if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
  {
    return "there is not enough memory for it";
  }
  const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error);
  const std::string  text = itkError != nullptr ? itkError->GetDescription() : error.what();
  std::size_t        start = text.rfind("[nrrd]");
  if (start == std::string::npos)
  {
    // the end of "itk::ERROR: Class(address): "
    const std::size_t address = text.find("): ");
    start = address == std::string::npos ? 0 : address + 3;
  }
  return text.substr(start, text.find('\n', start) - start);
}

itk::ImageIOBase::Pointer
MakeImageIO(const FrameFile & file)
{
  if (file.format == nullptr || file.format->imageIO == nullptr)
  {
    throw FileError(file.name, "of a format that cannot be checked; expected " + NamesOfFrameFormats());
  }
  for (const itk::LightObject::Pointer & object : itk::ObjectFactoryBase::CreateAllInstance("itkImageIOBase"))
  {
    auto * const io = dynamic_cast<itk::ImageIOBase *>(object.GetPointer());
    if (io != nullptr && io->GetNameOfClass() == std::string(file.format->imageIO))
    {
      return io;
    }
  }
  throw FileError(file.name,
                  std::string("of format ") + file.format->name +
                    ", which this program does not read; expected one that is linked to ITK's module " +
                    file.format->itkModule + " and has registered its format");
}

std::string
ComponentNameOf(const itk::ImageIOBase & io)
{
  std::string name = itk::ImageIOBase::GetComponentTypeAsString(io.GetComponentType());
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string
Describe(std::size_t width, std::size_t height, std::size_t frames, const std::string & pixel)
{
  return std::to_string(width) + " x " + std::to_string(height) + " pixels of type " + pixel +
         ", frames: " + std::to_string(frames);
}

/** Throws FileError unless the reader of ITK finds the same size, type and number of frames as the inspection. Readers
 * of ITK convert colours to grey, guess byte counts and count pages differently. */
void
RequireSameFrames(const FrameFile & file, const itk::ImageIOBase & io)
{
  const unsigned int dimensions = io.GetNumberOfDimensions();
  const std::size_t  frames = dimensions > 2 ? io.GetDimensions(2) : 1;
  std::string        found = std::to_string(dimensions) + " dimensions";
  if (dimensions >= 2 && (dimensions < 4 || (dimensions == 4 && io.GetDimensions(3) == 1)))
  {
    found = Describe(io.GetDimensions(0), io.GetDimensions(1), frames, ComponentNameOf(io));
  }
  if (io.GetNumberOfComponents() != 1)
  {
    found += ", " + std::to_string(io.GetNumberOfComponents()) + " components a pixel";
  }
  const std::string expected = Describe(file.width, file.height, file.frames, NameOf(file.pixel, file.stored));
  if (found != expected)
  {
    throw FileError(file.name, "ITK would read " + found + "; expected " + expected + ", as the file declares");
  }
}
} // namespace

FileError
PixelErrorOf(const std::string & file, const std::exception & error)
{
  return FileError(file, "its pixels cannot be read; " + CauseOf(error));
}

itk::ImageIOBase::Pointer
OpenImageIO(const FrameFile & file)
{
  RequireUnchanged(file);
  try
  {
    const itk::ImageIOBase::Pointer io = MakeImageIO(file);
    io->SetFileName(file.name);
    io->ReadImageInformation();
    RequireSameFrames(file, *io);
    return io;
  }
  catch (const FileError &)
  {
    throw;
  }
  catch (const std::exception & error)
  {
    throw FileError(file.name, "its header cannot be read; " + CauseOf(error));
  }
}

} // namespace sensornoise
