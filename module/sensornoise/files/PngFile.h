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
#ifndef sensornoise_files_PngFile_h
#define sensornoise_files_PngFile_h

#include "sensornoise/files/FileBytes.h"
#include "sensornoise/files/FrameFile.h"

namespace sensornoise
{

/** Fills in what a PNG file says of itself. \a file has its name and identity. Throws FileError unless all of its
 * chunks are there, in the right order and with the right checksums, and its pixels are grey values of 8 or 16 bits
 * that inflate to exactly as many as it declares. */
void
InspectPng(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
