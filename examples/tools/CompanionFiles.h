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
#ifndef CompanionFiles_h
#define CompanionFiles_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Reads a mask: 1 where the file, of any type but of the size of the frames, is not 0. Throws std::runtime_error. */
itk::Image<unsigned char, 2>::Pointer
ReadMask(const std::string & file, const FrameList & frames);

/** Opens the headers of dark frames, which must have the size and type of the others. Throws std::runtime_error. */
FrameList
OpenDark(const std::vector<std::string> & files, const FrameList & frames);

/** Says on standard error what is odd about the files and no error. */
void
TellWarningOf(const FrameList & frames);

} // namespace sensornoise::tools

#endif
