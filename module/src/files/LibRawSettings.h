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

/** Returns the settings of the camera of a file whose pixels are decoded. The Bayer pattern is "" for colours that are
 * no 2 x 2 mosaic (X-Trans, four colours). The black level is NaN unless it is uniform. If the file gives no bit depth
 * below 16, the bit depth is computed from the white level. It is then 0, not known, if a digital number exceeds it. */
CameraSettings
CameraSettingsOf(LibRaw & raw);

/** Returns the known lossy compression of the file in words; "" if there is none, or if LibRaw does not report it. */
std::string
LossOf(LibRaw & raw);

} // namespace sensornoise

#endif
#endif
