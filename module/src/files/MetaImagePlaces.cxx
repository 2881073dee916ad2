// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/MetaImagePlaces.h"

#include "sensornoise/FrameFile.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{
namespace
{
/** Where the header says that pixels begin: 0, a number of bytes, or nothing where they are at the end of the file. */
std::optional<std::uint64_t>
HeaderSizeOf(const std::string & file, const MetaImageHeader & header)
{
  const std::string text = header.Field("HeaderSize");
  if (text == "-1")
  {
    return std::nullopt;
  }
  const std::optional<std::uint64_t> size = text.empty() ? 0 : WholeNumber(text);
  if (!size || *size > INT32_MAX)
  {
    throw FileError(file, "HeaderSize is " + text + "; expected -1, 0 or a number of bytes");
  }
  return size;
}
} // namespace

std::vector<DataPlace>
PlacesOfMetaImage(const FrameFile & file, const MetaImageHeader & header, std::uint64_t size)
{
  const std::string                  dataFile = header.Field("ElementDataFile");
  const std::optional<std::uint64_t> headerSize = HeaderSizeOf(file.name, header);
  std::vector<DataPlace>             places;
  if (dataFile == "LOCAL" || dataFile == "Local" || dataFile == "local")
  {
    if (headerSize && *headerSize > 0 && *headerSize < header.end)
    {
      throw FileError(file.name,
                      "HeaderSize is " + std::to_string(*headerSize) + ", within the header of " +
                        std::to_string(header.end) + " bytes; expected the pixels after it");
    }
    const std::uint64_t offset = headerSize && *headerSize > 0 ? *headerSize : header.end;
    places.push_back({ file.name, std::min(offset, size), !headerSize, true });
    return places;
  }
  if (dataFile.find('%') != std::string::npos)
  {
    throw FileError(file.name,
                    "ElementDataFile is the pattern " + dataFile + "; expected LOCAL, LIST or the name of one file");
  }
  if (dataFile.rfind("LIST", 0) != 0)
  {
    places.push_back({ PathOfDataFile(file.name, dataFile), headerSize.value_or(0), !headerSize, false });
    return places;
  }
  const std::string dimension = WithoutBlanks(dataFile.substr(4));
  if (header.Field("NDims") != "3" || !(dimension.empty() || dimension == "2"))
  {
    throw FileError(file.name,
                    "ElementDataFile is " + dataFile + "; expected a list with one file for each frame of a 3-D image");
  }
  if (header.list.size() != file.frames)
  {
    throw FileError(file.name,
                    (header.list.size() < file.frames ? "truncated: " : "") + std::to_string(header.list.size()) +
                      " whole lines in its list of data files, expected " + std::to_string(file.frames));
  }
  for (const std::string & line : header.list)
  {
    places.push_back({ PathOfDataFile(file.name, line), headerSize.value_or(0), !headerSize, false });
  }
  return places;
}

} // namespace sensornoise
