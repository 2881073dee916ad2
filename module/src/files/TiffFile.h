// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffFile_h
#define sensornoise_files_TiffFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as a TIFF, or a BigTIFF, of either byte order. */
bool
IsHeadOfTiff(const std::string & head, const std::string & name);

/** Fills in what a TIFF, or a BigTIFF, says of itself. \a file has its name and identity. Throws FileError unless its
 * pages are all there, of one size and kind, and TiffStrips has nothing against them. */
void
InspectTiff(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
