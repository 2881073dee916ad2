// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PngFile_h
#define sensornoise_files_PngFile_h

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as a PNG. */
bool
IsHeadOfPng(const std::string & head, const std::string & name);

/** Fills in what a PNG file says of itself. \a file has its name and identity. Throws FileError unless all of its
 * chunks are there, in the right order and with the right checksums, and its pixels are grey values of 8 or 16 bits
 * that inflate to exactly as many as it declares. */
void
InspectPng(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
