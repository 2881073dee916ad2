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
#include "input/FrameHeader.h"

#include "input/ErrorText.h"
#include "input/FileCompleteness.h"
#include "input/InputError.h"
#include "itkImageFileReader.h" // registers the formats that ITK was built with
#include "itkImageIOFactory.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

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
} // namespace

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

} // namespace sensornoise::tools
