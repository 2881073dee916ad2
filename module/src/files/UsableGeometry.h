// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_UsableGeometry_h
#define sensornoise_files_UsableGeometry_h

#include "sensornoise/FrameFile.h"

namespace sensornoise
{

/** Returns a geometry as a header gives it with the default in place of what an image cannot have. A spacing below 0 is
 * a direction turned around. */
StackGeometry
UsableGeometry(const StackGeometry & given);

} // namespace sensornoise

#endif
