// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_NrrdFile_h
#define sensornoise_files_NrrdFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** Whether a file begins as a NRRD file, whatever its name. */
bool
IsHeadOfNrrd(const std::string & head, const std::string & name);

/** Fills in what a NRRD file says of itself. \a file has its name and identity. Throws FileError unless all of its
 * pixels are there, raw or in a stream of gzip that is whole, in the file or in data files. */
void
InspectNrrd(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** The paths of the files that hold its pixels. Throws FileError where the header cannot be read. */
std::vector<std::string>
DataFilesOfNrrd(FileBytes & bytes, const std::string & name);

} // namespace sensornoise

#endif
