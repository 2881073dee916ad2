// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_MrawFile_h
#define sensornoise_files_MrawFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** Whether a file is one of the two of a recording of a Photron camera, which have no mark of their own: by its name,
 * .mraw, or .cihx or .cih. */
bool
IsHeadOfMraw(const std::string & head, const std::string & name);

/** Fills in what a recording of a Photron camera says of itself: the pixels in a .mraw file, their size and number in a
 * .cihx or .cih file of the same name beside it. \a file is either and has its name and identity. Throws FileError
 * unless both are there, and the pixels are exactly those of the header. */
void
InspectMraw(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** The path of the other file of a recording. Throws FileError where it is missing. */
std::vector<std::string>
DataFilesOfMraw(FileBytes & bytes, const std::string & name);

} // namespace sensornoise

#endif
