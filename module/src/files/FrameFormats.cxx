// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{
const std::vector<FrameFormat> &
FrameFormats()
{
  static const std::vector<FrameFormat> formats{
    // before TIFF, as which most raw files begin
    { "camera raw", false, IsHeadOfRawCamera, InspectRawCamera },
    { "TIFF", false, IsHeadOfTiff, InspectTiff },
    { "PNG", true, IsHeadOfPng, InspectPng },
    { "MetaImage", true, IsHeadOfMetaImage, InspectMetaImage, DataFilesOfMetaImage },
    { "NRRD", true, IsHeadOfNrrd, InspectNrrd, DataFilesOfNrrd },
    { "SER", false, IsHeadOfSer, InspectSer },
    { "MRAW", false, IsHeadOfMraw, InspectMraw, DataFilesOfMraw },
    { "FITS", false, IsHeadOfFits, InspectFits },
    { "NPY", false, IsHeadOfNpy, InspectNpy },
    { "PGM", false, IsHeadOfPnm, InspectPnm },
  };
  return formats;
}

std::string
HeadOf(FileBytes & bytes)
{
  constexpr std::size_t mostBytes = 512;
  std::string           head(mostBytes, '\0');
  head.resize(bytes.ReadSome(0, head.data(), head.size()));
  return head;
}

const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name)
{
  const auto & formats = FrameFormats();
  const auto   found = std::find_if(
    formats.begin(), formats.end(), [&](const FrameFormat & format) { return format.isItsHead(head, name); });
  return found == formats.end() ? nullptr : &*found;
}

std::vector<std::string>
DataFilesOf(const std::string & name)
{
  try
  {
    FileBytes                 bytes(name);
    const FrameFormat * const format = FindFrameFormat(HeadOf(bytes), name);
    return format == nullptr || format->dataFiles == nullptr ? std::vector<std::string>()
                                                             : format->dataFiles(bytes, name);
  }
  catch (const FileError &)
  {
    return {};
  }
}

bool
HasEnding(const std::string & name, std::initializer_list<const char *> endings)
{
  return std::any_of(endings.begin(), endings.end(), [&](const std::string & ending) {
    return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  });
}

std::string
NamesOfFrameFormats()
{
  const auto & formats = FrameFormats();
  std::string  names = formats.front().name;
  for (std::size_t k = 1; k < formats.size(); ++k)
  {
    names += std::string(k + 1 < formats.size() ? ", " : " or ") + formats[k].name;
  }
  return names;
}

} // namespace sensornoise
