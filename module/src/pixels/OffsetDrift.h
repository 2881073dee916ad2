// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_OffsetDrift_h
#define sensornoise_pixels_OffsetDrift_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

struct PixelLight;

/** Whether the further series of light are one line a + b mean over the whole frame: then a common offset drifts, and
 * no second light changes. */
SensorNoise_EXPORT bool
IsOffsetDrift(const PixelLight & data);

} // namespace sensornoise

#endif
