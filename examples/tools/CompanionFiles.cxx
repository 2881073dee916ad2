// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/CompanionFiles.h"

#include "sensornoise/FrameFile.h"
#include "tools/ImageOnFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace sensornoise::tools
{

itk::Image<unsigned char, 2>::Pointer
ReadMask(const std::string & file, const FrameList & frames)
try
{
  const FrameList list = OpenFrames({ file });
  if (list.isStack)
  {
    throw FileError(file, "has " + std::to_string(list.frames) + " frames; expected one image");
  }
  if (list.width != frames.width || list.height != frames.height)
  {
    throw FileError(file,
                    "has " + std::to_string(list.width) + " x " + std::to_string(list.height) +
                      " pixels, but the frames have " + std::to_string(frames.width) + " x " +
                      std::to_string(frames.height) + "; expected the same size");
  }
  const itk::Image<double, 2>::Pointer image = ReadImage(list);
  auto                                 mask = itk::Image<unsigned char, 2>::New();
  mask->SetRegions(image->GetLargestPossibleRegion());
  mask->Allocate();
  const double * values = image->GetBufferPointer();
  const auto     unknown =
    std::count_if(values, values + list.width * list.height, [](double value) { return std::isnan(value); });
  if (unknown > 0)
  {
    throw FileError(file, "has " + std::to_string(unknown) + " pixels that are NaN; expected 0 or another number");
  }
  std::transform(values, values + list.width * list.height, mask->GetBufferPointer(), [](double value) {
    return value != 0.0 ? 1 : 0;
  });
  return mask;
}
catch (const FileError & error)
{
  throw std::runtime_error(std::string("the mask ") + error.what());
}

void
WarnOfSharedDarkFrames(const std::vector<std::string> & dark, const std::vector<std::string> & frames)
{
  const auto placeOf = [](const std::string & name) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(name, ignored);
  };
  std::set<std::filesystem::path> places;
  for (const std::string & name : frames)
  {
    places.insert(placeOf(name));
  }
  for (const std::string & name : dark)
  {
    if (places.count(placeOf(name)) != 0)
    {
      std::cerr << "warning: " << name
                << " is given as a frame and as a dark frame (--dark). Record dark frames of their own, in the dark\n";
      return;
    }
  }
}

FrameList
OpenDark(const std::vector<std::string> & files,
         const FrameList &                frames,
         const std::string &              rawLayout,
         const FrameChoice &              choice)
{
  FrameList dark = OpenFrames(files, {}, rawLayout, choice);
  PrintWarningOf(dark);
  if (DescribeFrame(dark) != DescribeFrame(frames))
  {
    throw std::runtime_error("the dark frames have " + DescribeFrame(dark) + " (" + files.front() +
                             "), but the frames have " + DescribeFrame(frames) +
                             "; record dark frames with the settings of the frames");
  }
  return dark;
}

void
PrintWarningOf(const FrameList & frames)
{
  const std::string warning = WarningOf(frames);
  if (!warning.empty())
  {
    std::cerr << "warning: " << warning << std::endl;
  }
}

} // namespace sensornoise::tools
