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
#include "FormatCompleteness.h"
#include "TextHeader.h"

#include <cstdlib>

namespace sensornoise::tools
{
namespace fs = std::filesystem;

void
CheckMetaImage(const std::string & file, itk::MetaImageIO & io)
{
  const TextHeader    header = ReadTextHeader(file, "=:", "ElementDataFile");
  const std::string   dataFile = header.Field("ElementDataFile");
  const fs::path      folder = fs::path(file).parent_path();
  const std::uint64_t bytes = io.GetImageSizeInBytes();
  const int           headerSize = io.GetMetaImagePointer()->HeaderSize();
  const std::uint64_t skipped = headerSize > 0 ? static_cast<std::uint64_t>(headerSize) : 0;

  if (!io.GetMetaImagePointer()->BinaryData())
  {
    Refuse(file, "BinaryData is False, and pixels written as text cannot be checked; expected binary pixels");
  }
  if (dataFile.find('%') != std::string::npos)
  {
    Refuse(file, "ElementDataFile is the pattern " + dataFile + "; expected LOCAL, LIST or the name of one file");
  }
  std::uint64_t expected = bytes;
  if (io.GetMetaImagePointer()->CompressedData())
  {
    expected = std::strtoull(header.Field("CompressedDataSize").c_str(), nullptr, 10);
    if (expected == 0)
    {
      Refuse(file, "compressed without a CompressedDataSize in the header; without it nobody can tell if it is whole");
    }
  }
  if (dataFile == "LOCAL" || dataFile == "Local" || dataFile == "local")
  {
    RequireBytes(file, file, skipped > 0 ? skipped : header.end, expected);
  }
  else if (dataFile.rfind("LIST", 0) == 0)
  {
    const std::uint64_t frames = io.GetNumberOfDimensions() == 3 ? io.GetDimensions(2) : 0;
    const std::string   dimension = Trimmed(dataFile.substr(4));
    if (frames == 0 || !(dimension.empty() || dimension == "2"))
    {
      Refuse(file, "ElementDataFile is " + dataFile + "; expected a list with one file for each frame of a 3-D image");
    }
    if (header.lines.size() < frames)
    {
      Refuse(file,
             "truncated: " + std::to_string(header.lines.size()) + " whole lines in its list of data files, expected " +
               std::to_string(frames));
    }
    for (std::uint64_t frame = 0; frame < frames; ++frame)
    {
      RequireBytes(file, folder / header.lines[frame], skipped, expected / frames);
    }
  }
  else
  {
    RequireBytes(file, folder / dataFile, skipped, expected);
  }
}

} // namespace sensornoise::tools
