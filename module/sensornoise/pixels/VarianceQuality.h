// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceQuality_h
#define sensornoise_pixels_VarianceQuality_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cstdint>
#include <vector>

/** \file
 * Whether the line is all there is to the variance, in the smoother half of the scene, too. */

namespace sensornoise
{

class ProjectedVariance;

/** The line through the smoother half of the pixels, where motion could do least. */
SensorNoise_EXPORT VarianceLine
FitFlatHalf(const ProjectedVariance &         projected,
            const std::vector<std::uint8_t> & mask,
            const VarianceLine &              line,
            const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
