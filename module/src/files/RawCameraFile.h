// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_RawCameraFile_h
#define sensornoise_files_RawCameraFile_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file is a raw file of a camera: DNG, CR2, CR3, NEF, ARW, RAF, ORF, RW2 and others. Most of them begin as a
 * TIFF does: then its first directory and those below are read for the version of DNG or for the colours of a mosaic,
 * and where these are not to be found the ending of the name tells. */
bool
IsHeadOfRawCamera(const std::string & head, const std::string & name);

/** Whether this build reads raw files of cameras: SensorNoise_USE_LibRaw. */
SensorNoise_EXPORT bool
ReadsRawCameraFiles();

/** Fills in what the raw file of a camera says of itself, by LibRaw, and all of `FrameFile::camera`. \a file has its
 * name and identity. A frame has the codes of the visible area as they are in the file, without black level, white
 * balance or colours: unsigned short, one a pixel. All of them are decoded for the check, and not kept.
 *
 * Throws FileError without LibRaw, for a file that LibRaw cannot read, which ends before its pixels do or whose decoder
 * meets an error, for several colours a pixel, several frames, and what is known to be compressed with loss. Of a DNG
 * it is also checked that its directory, its strips or tiles, and LibRaw say the same (RequireWholeRawTiff()). */
void
InspectRawCamera(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
