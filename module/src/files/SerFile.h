// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_SerFile_h
#define sensornoise_files_SerFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as a SER, the format of astronomers' recordings. */
bool
IsHeadOfSer(const std::string & head, const std::string & name);

/** Fills in what a SER says of itself: "SER format description version 3" of G. Hahn, 2014. \a file has its name and
 * identity. Throws FileError unless it holds exactly the frames that it declares, with or without a time for each, and
 * of one value a pixel. Of a file that says 0 frames, because the program that wrote it did not close it, all whole
 * frames are read, and FrameFile::warning says so.
 *
 * Of the order of the bytes the description says one thing, and the first programs wrote the other, so that today
 * either is found. It is taken to be as the programs have it (LittleEndian 0: lowest byte first), unless the first
 * frame says otherwise: in the wrong order neighbours differ much more. */
void
InspectSer(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
