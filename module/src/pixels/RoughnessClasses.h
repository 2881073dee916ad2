// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_RoughnessClasses_h
#define sensornoise_pixels_RoughnessClasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

struct InitialNoiseModel;
struct ReferenceFrame;

/** Number of classes into which pixels are sorted by the roughness of their surroundings: the energy of the derivatives
 * in a neighbourhood as wide as the motion, over the noise. */
inline constexpr std::size_t RoughnessClasses = 24;

/** Returns the roughness class of every pixel, from 0 (flat) to RoughnessClasses - 1. The limits are quantiles of the
 * mask's pixels. */
SensorNoise_EXPORT std::vector<std::uint8_t>
ClassifyRoughness(const ReferenceFrame &            frame,
                  const InitialNoiseModel &         model,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
