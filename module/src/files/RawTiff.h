// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_RawTiff_h
#define sensornoise_files_RawTiff_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** Kind of a TIFF as a raw file of a camera. */
enum class RawTiffKind
{
  None,
  Dng,   ///< Adobe's DNG
  Mosaic ///< another one with the colours of a mosaic: NEF, ARW, PEF and others
};

/** Returns the kind by the first directory of a TIFF and the directories below it. Throws FileError where they are
 * damaged. */
RawTiffKind
RawTiffKindOf(const std::string & file, FileBytes & bytes);

/** Throws FileError unless the pixels of a raw file that is a TIFF are all in the file; nothing is said of others. Of
 * every TIFF: its strips and tiles, as far as its directories list them. Of a DNG, beyond that: a directory declares an
 * image of \a width x \a height codes, as LibRaw would read it [pixels]; its codes are whole numbers, uncompressed or
 * as JPEG without loss, and not rounded through a table; and its strips or tiles hold exactly as many of them, each
 * JPEG to its end. */
SensorNoise_EXPORT void
RequireWholeRawTiff(const std::string & file, FileBytes & bytes, std::uint64_t width, std::uint64_t height);

} // namespace sensornoise

#endif
