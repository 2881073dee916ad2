// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FitsFile_h
#define sensornoise_files_FitsFile_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as FITS does. */
SensorNoise_EXPORT bool
IsHeadOfFits(const std::string & head, const std::string & name);

/** Reads the headers of all units of a FITS file. Exactly one of them must be an image: a frame has two axes, a stack
 * three.
 *
 * Integers with the BZERO of unsigned ones are read as these. Where BSCALE, BZERO or BLANK say something else, values
 * are read as double: BZERO + BSCALE times the number, NaN for BLANK. Rows are read in the order of the file. Throws
 * FileError for compressed images, for several images, for integers of 64 bits, and where DATASUM does not fit the
 * data. FITS standard, version 4. */
SensorNoise_EXPORT void
InspectFits(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
