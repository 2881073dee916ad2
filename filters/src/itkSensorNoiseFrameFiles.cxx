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
#include "itkSensorNoiseFrameFiles.h"

#include "base/FreeMemory.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"
#include "files/FrameFormats.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace sensornoise
{
namespace
{
void
RequireAlike(const FrameFile & found, const FrameFile & first)
{
  if (found.width != first.width || found.height != first.height)
  {
    const auto size = [](const FrameFile & file) {
      return std::to_string(file.width) + " x " + std::to_string(file.height);
    };
    throw FileError(
      found.name,
      size(found) + " pixels, but " + first.name + " has " + size(first) +
        "; all frames must have the same size. Leave the file out, or name the frames by a pattern, 'frame_*.tif'");
  }
  if (found.pixel != first.pixel)
  {
    throw FileError(found.name,
                    "component type " + NameOf(found.pixel) + ", but " + first.name + " has " + NameOf(first.pixel) +
                      "; all frames must have the same component type");
  }
}

/** Throws unless there is memory for a frame, before any is allocated. */
void
RequireMemoryForFrame(const FrameFile & file)
{
  const std::string size = std::to_string(file.width) + " x " + std::to_string(file.height);
  RequireMemory(static_cast<double>(file.width) * static_cast<double>(file.height) *
                  static_cast<double>(SizeOf(file.pixel)),
                file.name + ": a frame of " + size + " pixels");
}

/** Returns the geometry of one slice along x and y. */
FrameListGeometry
WithoutTime(FrameListGeometry geometry)
{
  geometry.spacing[2] = 1.0;
  geometry.origin[2] = 0.0;
  return geometry;
}

void
ReadFile(const FrameFile & file, std::size_t first, std::size_t count, void * buffer)
{
  RequireUnchanged(file);
  try
  {
    file.reader->Read(file, first, count, buffer);
  }
  catch (const FileError &)
  {
    RequireUnchanged(file); // that would be the better reason
    throw;
  }
  RequireUnchanged(file);
}
} // namespace

std::vector<std::string>
FrameList::Names() const
{
  std::vector<std::string> names;
  std::transform(
    files.begin(), files.end(), std::back_inserter(names), [](const FrameFile & file) { return file.name; });
  return names;
}

FrameList
OpenFrames(const std::vector<std::string> & names,
           const BeforeInflating &          beforeInflating,
           const std::string &              rawLayout,
           const FrameChoice &              choice)
{
  if (names.empty())
  {
    throw std::invalid_argument("no file was given; expected image files in time order, or one stack");
  }
  std::optional<RawLayout> layout;
  if (!rawLayout.empty())
  {
    layout = ReadRawLayout(rawLayout);
  }
  FrameList list;
  list.files.reserve(names.size());
  for (const std::string & name : names)
  {
    const auto requireFitting = [&](const FrameFile & file) {
      if (list.files.empty())
      {
        RequireMemoryForFrame(file);
      }
      else
      {
        RequireAlike(file, list.files.front());
      }
    };
    const auto beforeWork = [&](const FrameFile & known) {
      requireFitting(known);
      if (beforeInflating)
      {
        beforeInflating(known);
      }
    };
    FrameFile file = layout ? InspectRawFile(name, *layout) : InspectFrameFile(name, beforeWork);
    ChooseFrames(file, choice);
    if (file.frames > 1 && !list.files.empty() && !list.isStack)
    {
      throw FileError(name,
                      "has " + std::to_string(file.frames) + " frames, but " + list.files.front().name +
                        " has one; expected stacks alone, or one frame a file");
    }
    requireFitting(file);
    if (list.files.empty())
    {
      list.isStack = file.frames > 1;
      list.pixel = file.pixel;
      list.width = file.width;
      list.height = file.height;
      list.camera = file.camera;
      list.geometry = list.isStack ? file.geometry : WithoutTime(file.geometry);
    }
    list.bytes += file.bytes;
    list.frames += file.frames;
    list.files.push_back(file);
  }
  return list;
}

void
ReadFrames(const FrameList & list, std::size_t first, std::size_t count, void * buffer)
{
  const std::size_t frameBytes = list.bytes / list.frames;
  const bool        isList = list.files.size() == list.frames;
  std::size_t       index = isList ? first : 0;
  for (std::size_t begin = index; begin < first + count; ++index)
  {
    const FrameFile & file = list.files.at(index);
    const std::size_t end = begin + file.frames;
    const std::size_t from = std::max(first, begin);
    const std::size_t to = std::min(first + count, end);
    if (from < to)
    {
      ReadFile(file, from - begin, to - from, static_cast<char *>(buffer) + (from - first) * frameBytes);
    }
    begin = end;
  }
}

std::string
WarningOf(const FrameList & list)
{
  std::vector<const FileIdentity *> sorted;
  for (const FrameFile & file : list.files)
  {
    sorted.push_back(&file.identities.front());
  }
  const auto place = [](const FileIdentity * file) { return std::tie(file->device, file->inode); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto * a, const auto * b) { return place(a) < place(b); });
  const auto twice = std::adjacent_find(
    sorted.begin(), sorted.end(), [&](const auto * a, const auto * b) { return place(a) == place(b); });
  if (twice != sorted.end())
  {
    return (*twice)->name + ": is given twice, the second time as " + (*(twice + 1))->name +
           "; expected each frame once";
  }
  const auto odd =
    std::find_if(list.files.begin(), list.files.end(), [](const FrameFile & file) { return !file.warning.empty(); });
  return odd == list.files.end() ? "" : odd->name + ": " + odd->warning;
}

std::string
DescribeFrame(const FrameList & list)
{
  return std::to_string(list.width) + " x " + std::to_string(list.height) + " pixels of type " + NameOf(list.pixel);
}

} // namespace sensornoise
