// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_NpyFile_h
#define sensornoise_files_NpyFile_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{

/** Whether a file begins as those of numpy.save() do. */
SensorNoise_EXPORT bool
IsHeadOfNpy(const std::string & head, const std::string & name);

/** Reads the header of a NPY file, versions 1 to 3: an array of two axes (rows, columns) is a frame, one of three
 * (frames, rows, columns) a stack. Throws FileError unless its bytes are exactly the pixels that it declares, in C
 * order and of a type that StoredNumber or FramePixel has. numpy.lib.format describes the format. */
SensorNoise_EXPORT void
InspectNpy(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

} // namespace sensornoise

#endif
