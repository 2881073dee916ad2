// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_PixelsBySignal_h
#define sensornoise_correlation_PixelsBySignal_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Returns the pixels whose \a take is not 0 in the order of their signal \a light, which must be finite. Pixels of
 * equal signal are in the order of their index. */
SensorNoise_EXPORT std::vector<std::uint32_t>
SortPixelsBySignal(const std::vector<float> & light, const std::vector<std::uint8_t> & take);

} // namespace sensornoise

#endif
