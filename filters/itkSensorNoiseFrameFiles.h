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
#ifndef FrameInput_h
#define FrameInput_h

#include "itkImageIOBase.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The frames that a tool was given, after their headers have been checked: one stack file, or one file per frame. */
struct FrameInput
{
  std::vector<std::string> files;
  bool                     isStack{ false }; // one file with all frames
  itk::IOComponentEnum     component{ itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE };
  std::size_t              width{ 0 };  // pixels
  std::size_t              height{ 0 }; // pixels
  std::size_t              frames{ 0 };
  bool                     streams{ false }; // can be read a few frames at a time
  std::uint64_t            bytes{ 0 };       // of all frames, uncompressed
};

/** Opens the header of every file, reads no pixel, and throws InputError unless all is well: each file exists, is an
 * image in a format that ITK reads, has one component of type unsigned char, unsigned short, short, float or double
 * for each pixel and is complete (CheckFileIsComplete()), and all have the same size and component type. One 3-D file
 * is a stack; a list holds 2-D files, or 3-D files of one slice. */
FrameInput
OpenFrames(const std::vector<std::string> & files);

} // namespace sensornoise::tools

#endif
