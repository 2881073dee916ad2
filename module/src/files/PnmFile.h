// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PnmFile_h
#define sensornoise_files_PnmFile_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as Netpbm's formats do: PBM, PGM, PPM. */
SensorNoise_EXPORT bool
IsHeadOfPnm(const std::string & head, const std::string & name);

/** Reads the headers of a binary PGM file (P5, 8 or 16 bits). It may have several images, one after the other: frames.
 * Throws FileError unless all are whole and alike, and for colours, text and bitmaps. A maximum of 2^n -
 * 1 is taken for n bits of the camera. */
SensorNoise_EXPORT void
InspectPnm(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
