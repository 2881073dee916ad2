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
class VarianceFit;
struct ClassFit;

/** The line through the smoother half of the pixels of \a fit, those of \a mask, where motion could do least. All
 * pixels of the classes that are kept must be in the mask. */
SensorNoise_EXPORT VarianceLine
FitFlatHalf(const VarianceFit &               fit,
            const ProjectedVariance &         projected,
            const ClassFit &                  classes,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
