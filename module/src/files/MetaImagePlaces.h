// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_MetaImagePlaces_h
#define sensornoise_files_MetaImagePlaces_h

#include "files/DataFile.h"
#include "sensornoise/FrameFile.h"
#include "files/MetaImageHeader.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Where the pixels of a MetaImage of \a size bytes are, or, in a list, those of each frame. Throws FileError where
 * that is within the header, or a pattern of names, or not a file for each frame. */
std::vector<DataPlace>
PlacesOfMetaImage(const FrameFile & file, const MetaImageHeader & header, std::uint64_t size);

} // namespace sensornoise

#endif
