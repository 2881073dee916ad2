// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_LibRawSettings_h
#define sensornoise_files_LibRawSettings_h
#ifdef SENSORNOISE_LIBRAW

#  include "sensornoise/CameraSettings.h"

#  include <libraw/libraw.h>

#  include <string>

namespace sensornoise
{

/** What LibRaw says of a file whose codes are decoded. Colours that are no 2 x 2 mosaic (X-Trans, four colours) have no
 * pattern; a black level that is not the same everywhere is none. Where the file has 16 bits a code, the bit depth is
 * that of the white level if all codes fit it, else it is not known. */
CameraSettings
CameraSettingsOf(LibRaw & raw);

/** In which way the file is known to be compressed with loss, in words; empty: in none, or LibRaw does not tell. */
std::string
LossOf(LibRaw & raw);

} // namespace sensornoise

#endif
#endif
