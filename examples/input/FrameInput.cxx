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
#include "itkImageIOFactory.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <tiffio.h>
#include <vector>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

/** libtiff writes to standard error, and what matters there is found by CheckFileIsComplete(). */
class SilentTiff
{
public:
  SilentTiff()
    : m_Warning(TIFFSetWarningHandler(nullptr))
    , m_Error(TIFFSetErrorHandler(nullptr))
  {}
  ~SilentTiff()
  {
    TIFFSetWarningHandler(m_Warning);
    TIFFSetErrorHandler(m_Error);
  }
  ITK_DISALLOW_COPY_AND_MOVE(SilentTiff);

private:
  TIFFErrorHandler m_Warning;
  TIFFErrorHandler m_Error;
};

std::string
NameOf(itk::IOComponentEnum component)
{
  std::string name = itk::ImageIOBase::GetComponentTypeAsString(component);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string
SizeOf(std::size_t width, std::size_t height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

/** The cause alone: ITK puts the class and its address before it, NRRD a chain of "trouble" with the cause at the end.
 */
std::string
CauseOf(const itk::ExceptionObject & exception)
{
  const std::string text = exception.GetDescription();
  const std::size_t nrrd = text.rfind("[nrrd]");
  const std::size_t address = text.find("): ");
  const std::size_t start = nrrd != std::string::npos ? nrrd : address != std::string::npos ? address + 3 : 0;
  return text.substr(start, text.find('\n', start) - start);
}

void
CheckIsReadable(const std::string & file)
{
  std::error_code error;
  if (fs::is_directory(file, error))
  {
    throw InputError(file + ": is a folder; expected an image file");
  }
  if (!fs::exists(file, error))
  {
    throw InputError(file + ": does not exist; expected an image file");
  }
  if (!std::ifstream(file, std::ios::binary))
  {
    throw InputError(file + ": cannot be opened; expected an image file that may be read");
  }
  if (fs::is_regular_file(file, error) && fs::file_size(file, error) == 0)
  {
    throw InputError(file + ": has 0 bytes; expected an image file");
  }
}

bool
IsFormat(const itk::ImageIOBase & io, const std::string & imageIO)
{
  return io.GetNameOfClass() == imageIO;
}

itk::ImageIOBase::Pointer
OpenHeader(const std::string & file)
{
  CheckIsReadable(file);
  try
  {
    itk::ImageIOBase::Pointer io =
      itk::ImageIOFactory::CreateImageIO(file.c_str(), itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    if (io.IsNull())
    {
      throw InputError(file + ": not an image in a format that ITK reads, or damaged at its start; expected TIFF, PNG, "
                              "MetaImage, NRRD or another format of ITK");
    }
    io->SetFileName(file);
    if (IsFormat(*io, "PNGImageIO"))
    {
      // ITK 5.2 ends the process if it meets the end of a PNG file in its header
      CheckFileIsComplete(*io);
    }
    io->ReadImageInformation();
    return io;
  }
  catch (const itk::ExceptionObject & exception)
  {
    throw InputError(file + ": its header cannot be read; " + CauseOf(exception));
  }
}

void
CheckPixels(const std::string & file, const itk::ImageIOBase & io)
{
  const unsigned int dimensions = io.GetNumberOfDimensions();
  if (dimensions < 2 || dimensions > 3)
  {
    throw InputError(file + ": " + std::to_string(dimensions) + " dimensions; expected 2 (a frame) or 3 (a stack)");
  }
  for (unsigned int i = 0; i < dimensions; ++i)
  {
    if (io.GetDimensions(i) == 0)
    {
      throw InputError(file + ": size 0 along axis " + std::to_string(i) + "; expected at least 1");
    }
  }
  if (io.GetNumberOfComponents() != 1)
  {
    throw InputError(file + ": " + std::to_string(io.GetNumberOfComponents()) +
                     " components a pixel; expected 1 grey value");
  }
  switch (io.GetComponentType())
  {
    case itk::IOComponentEnum::UCHAR:
    case itk::IOComponentEnum::USHORT:
    case itk::IOComponentEnum::SHORT:
    case itk::IOComponentEnum::FLOAT:
    case itk::IOComponentEnum::DOUBLE:
      return;
    default:
      throw InputError(file + ": component type " + NameOf(io.GetComponentType()) +
                       " is not supported; expected unsigned char, unsigned short, short, float or double");
  }
}

/** The header of one file, checked, as if it were the only one. */
FrameInput
Describe(const std::string & file, itk::ImageIOBase & io)
{
  // of a TIFF that ITK would convert to colours it tells what the file really holds
  const bool isTiff = IsFormat(io, "TIFFImageIO");
  if (isTiff)
  {
    CheckFileIsComplete(io);
  }
  CheckPixels(file, io);
  if (!isTiff)
  {
    CheckFileIsComplete(io);
  }
  FrameInput input;
  input.files = { file };
  input.component = io.GetComponentType();
  input.width = io.GetDimensions(0);
  input.height = io.GetDimensions(1);
  input.frames = io.GetNumberOfDimensions() == 3 ? io.GetDimensions(2) : 1;
  input.isStack = input.frames > 1;
  input.streams = !input.isStack || io.CanStreamRead();
  input.bytes = std::uint64_t{ input.width } * input.height * input.frames * io.GetComponentSize();
  return input;
}

void
RequireSame(const std::string & file, const FrameInput & found, const FrameInput & expected)
{
  const std::string & first = expected.files.front();
  if (found.width != expected.width || found.height != expected.height)
  {
    throw InputError(file + ": " + SizeOf(found.width, found.height) + " pixels, but " + first + " has " +
                     SizeOf(expected.width, expected.height) + "; all frames must have the same size");
  }
  if (found.component != expected.component)
  {
    throw InputError(file + ": component type " + NameOf(found.component) + ", but " + first + " has " +
                     NameOf(expected.component) + "; all frames must have the same component type");
  }
}

void
RequireUnchanged(const FrameInput & input, const std::string & file, const FrameInput & found)
{
  const std::size_t frames = input.isStack ? input.frames : 1;
  if (found.width != input.width || found.height != input.height || found.frames != frames ||
      found.component != input.component)
  {
    throw InputError(file + ": has changed since it was opened; now " + SizeOf(found.width, found.height) +
                     " pixels, frames: " + std::to_string(found.frames) + ", " + NameOf(found.component) +
                     ", expected " + SizeOf(input.width, input.height) + " pixels, frames: " + std::to_string(frames) +
                     ", " + NameOf(input.component));
  }
}

} // namespace

FrameInput
OpenFrames(const std::vector<std::string> & files)
{
  if (files.empty())
  {
    throw InputError("no file was given; expected image files in time order, or one stack");
  }
  const SilentTiff silent;
  FrameInput       input;
  for (const std::string & file : files)
  {
    const itk::ImageIOBase::Pointer io = OpenHeader(file);
    const FrameInput                found = Describe(file, *io);
    if (found.isStack && files.size() > 1)
    {
      throw InputError(file + ": has " + std::to_string(found.frames) + " frames, and " + std::to_string(files.size()) +
                       " files were given; expected one stack alone, or one frame a file");
    }
    if (input.files.empty())
    {
      input = found;
      continue;
    }
    RequireSame(file, found, input);
    input.files.push_back(file);
    input.bytes += found.bytes;
    ++input.frames;
  }
  return input;
}

void
CheckUnchanged(const FrameInput & input, const std::string & file)
{
  const SilentTiff                silent;
  const itk::ImageIOBase::Pointer io = OpenHeader(file);
  RequireUnchanged(input, file, Describe(file, *io));
}

std::string
PixelErrorOf(const std::string & file, const itk::ExceptionObject & exception)
{
  return file + ": its pixels cannot be read; " + CauseOf(exception);
}

void
ReadFrame(const FrameInput & input, std::size_t frame, void * buffer)
{
  const SilentTiff                silent;
  const std::string               file = input.files.at(frame);
  const itk::ImageIOBase::Pointer io = OpenHeader(file);
  RequireUnchanged(input, file, Describe(file, *io));

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

} // namespace sensornoise::tools
