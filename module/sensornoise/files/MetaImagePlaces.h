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
#ifndef sensornoise_files_MetaImagePlaces_h
#define sensornoise_files_MetaImagePlaces_h

#include "sensornoise/files/DataFile.h"
#include "sensornoise/files/FrameFile.h"
#include "sensornoise/files/MetaImageHeader.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Where the pixels of a MetaImage of \a size bytes are, or, in a list, those of each frame: where MetaIO looks for
 * them. Throws FileError where that is within the header, or a pattern of names, or not a file for each frame. */
std::vector<DataPlace>
PlacesOfMetaImage(const FrameFile & file, const MetaImageHeader & header, std::uint64_t size);

} // namespace sensornoise

#endif
