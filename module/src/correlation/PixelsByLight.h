// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_PixelsByLight_h
#define sensornoise_correlation_PixelsByLight_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** The pixels that are taken, by their light, which is finite; those of the same light by their place. */
SensorNoise_EXPORT std::vector<std::uint32_t>
PixelsByLight(const std::vector<float> & light, const std::vector<std::uint8_t> & take);

} // namespace sensornoise

#endif
