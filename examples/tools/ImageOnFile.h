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
#ifndef ImageOnFile_h
#define ImageOnFile_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"

namespace sensornoise::tools
{

/** The pixels of a list that holds one frame, of any type: a double holds them all. Throws FileError. */
itk::Image<double, 2>::Pointer
ReadImage(const FrameList & list);

} // namespace sensornoise::tools

#endif
