// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_OffsetDrift_h
#define sensornoise_pixels_OffsetDrift_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

struct IlluminationResponses;

/** Returns whether each further illumination component is one line a + b mean over the whole frame. Then a common
 * offset drifts, and there is no second light source that changes. */
SensorNoise_EXPORT bool
IsOffsetDrift(const IlluminationResponses & data);

} // namespace sensornoise

#endif
