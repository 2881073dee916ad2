// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FitsFile.h"
#include "files/MetaImageFile.h"
#include "files/MrawFile.h"
#include "files/NpyFile.h"
#include "files/NrrdFile.h"
#include "files/PngFile.h"
#include "files/PnmFile.h"
#include "files/RawCameraFile.h"
#include "files/SerFile.h"
#include "files/TiffFile.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

const std::vector<FrameFormat> &
FrameFormats()
{
  static const std::vector<FrameFormat> formats{
    // before TIFF, as which most raw files begin
    { "camera raw", nullptr, nullptr, IsHeadOfRawCamera, InspectRawCamera },
    { "TIFF", nullptr, nullptr, IsHeadOfTiff, InspectTiff },
    { "PNG", "PNGImageIO", "ITKIOPNG", IsHeadOfPng, InspectPng },
    { "MetaImage", "MetaImageIO", "ITKIOMeta", IsHeadOfMetaImage, InspectMetaImage },
    { "NRRD", "NrrdImageIO", "ITKIONRRD", IsHeadOfNrrd, InspectNrrd },
    { "SER", nullptr, nullptr, IsHeadOfSer, InspectSer },
    { "MRAW", nullptr, nullptr, IsHeadOfMraw, InspectMraw },
    { "FITS", nullptr, nullptr, IsHeadOfFits, InspectFits },
    { "NPY", nullptr, nullptr, IsHeadOfNpy, InspectNpy },
    { "PGM", nullptr, nullptr, IsHeadOfPnm, InspectPnm },
  };
  return formats;
}

const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name)
{
  const auto & formats = FrameFormats();
  const auto   found = std::find_if(
    formats.begin(), formats.end(), [&](const FrameFormat & format) { return format.isItsHead(head, name); });
  return found == formats.end() ? nullptr : &*found;
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
