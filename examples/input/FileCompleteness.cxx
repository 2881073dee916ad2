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
#include "input/FileCompleteness.h"

#include "input/FormatCompleteness.h"

#include <cstdint>
#include <string>

namespace sensornoise::tools
{
namespace fs = std::filesystem;

std::uint64_t
SizeOfFile(const std::string & file, const fs::path & dataFile)
{
  std::error_code      error;
  const std::uintmax_t size = fs::file_size(dataFile, error);
  if (error)
  {
    Refuse(file, "its data file " + dataFile.string() + " does not exist or cannot be read");
  }
  return size;
}

void
RequireBytes(const std::string & file, const fs::path & dataFile, std::uint64_t offset, std::uint64_t expected)
{
  const std::uint64_t size = SizeOfFile(file, dataFile);
  const std::uint64_t found = size > offset ? size - offset : 0;
  if (found < expected)
  {
    const std::string place = fs::path(file) == dataFile ? "" : " in its data file " + dataFile.string();
    Refuse(file,
           "truncated: " + std::to_string(found) + " bytes of pixels" + place + ", expected " +
             std::to_string(expected));
  }
}

void
CheckFileIsComplete(itk::ImageIOBase & io)
{
  const std::string file = io.GetFileName();
  const std::string format = io.GetNameOfClass();
  if (auto * const metaImageIO = dynamic_cast<itk::MetaImageIO *>(&io))
  {
    CheckMetaImage(file, *metaImageIO);
  }
  else if (format == "TIFFImageIO")
  {
    CheckTiff(file, io);
  }
  else if (format == "PNGImageIO")
  {
    CheckPng(file);
  }
  else if (format == "NrrdImageIO")
  {
    CheckNrrd(file, io.GetImageSizeInBytes());
  }
  else if (format != "HDF5ImageIO" && format != "MINCImageIO")
  {
    const std::uint64_t found = SizeOfFile(file, file);
    const std::uint64_t expected = io.GetImageSizeInBytes();
    if (found < expected)
    {
      Refuse(file,
             std::to_string(found) + " bytes, fewer than the " + std::to_string(expected) +
               " of its pixels; truncated, or compressed in a format that cannot be checked; expected TIFF, PNG, "
               "MetaImage or NRRD");
    }
  }
}

} // namespace sensornoise::tools
