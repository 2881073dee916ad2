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

#include "input/FrameHeader.h"
#include "input/InputError.h"
#include "input/SilentTiff.h"

namespace sensornoise::tools
{
namespace
{
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

} // namespace sensornoise::tools
