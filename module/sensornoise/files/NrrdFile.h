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
#ifndef sensornoise_files_NrrdFile_h
#define sensornoise_files_NrrdFile_h

#include "sensornoise/files/FileBytes.h"
#include "sensornoise/files/FrameFile.h"

namespace sensornoise
{

/** Fills in what a NRRD file says of itself. \a file has its name and identity. Throws FileError unless all of its
 * pixels are there, raw or in a stream of gzip that is whole, in the file or in data files, and unless NrrdIO reads
 * them as they are. */
void
InspectNrrd(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
