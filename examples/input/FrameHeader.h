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
#ifndef FrameHeader_h
#define FrameHeader_h

#include "input/FrameInput.h"

#include "itkImageIOBase.h"

#include <cstddef>
#include <string>

namespace sensornoise::tools
{

/** Opens a file and reads its header, no pixel. Throws InputError unless it is an image in a format that ITK reads. */
itk::ImageIOBase::Pointer
OpenHeader(const std::string & file);

/** The header of one file, checked, as if it were the only one. Throws InputError unless it is a frame or a stack of
 * grey values of a type that is supported, and complete. */
FrameInput
Describe(const std::string & file, itk::ImageIOBase & io);

/** "unsigned short" */
std::string
NameOf(itk::IOComponentEnum component);

/** "640 x 480" */
std::string
SizeOf(std::size_t width, std::size_t height);

} // namespace sensornoise::tools

#endif
