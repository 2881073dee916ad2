// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_MetaImageFile_h
#define sensornoise_files_MetaImageFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** Whether a file may be a MetaImage, which has no mark of its own: its name ends as one, and fields begin. */
bool
IsHeadOfMetaImage(const std::string & head, const std::string & name);

/** Fills in what a MetaImage says of itself. \a file has its name and identity. Throws FileError unless all of its
 * pixels are there, in the file or in data files. */
void
InspectMetaImage(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** The paths of the files that hold its pixels. Throws FileError where the header cannot be read. */
std::vector<std::string>
DataFilesOfMetaImage(FileBytes & bytes, const std::string & name);

} // namespace sensornoise

#endif
