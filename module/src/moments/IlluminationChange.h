// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_IlluminationChange_h
#define sensornoise_moments_IlluminationChange_h

#include "SensorNoiseExport.h"

#include <vector>

namespace sensornoise
{

/** Returns the relative standard deviation over time of the illumination factor of frames [1], from the means of each
 * frame over some cells.
 *
 * \a frames holds the cells of each frame [DN], \a mean the same cells of the mean frame [DN]. Under another
 * illumination a frame is the mean frame times a factor, plus a level. Where the cells differ enough, this factor is
 * the illumination factor, for any offset. In a flat field the factor is not identifiable, but the change of the level
 * is. It counts as InMoments.strongIlluminationChange where its variance is InMoments.strongChangeOfFlat times
 * \a noiseDn2, an upper bound of the noise variance of the pixels [DN^2]. A frame counts as unchanged if most of its
 * difference from the mean frame is neither a level nor a factor, but noise or another scene. */
SensorNoise_EXPORT double
ComputeIlluminationChange(const std::vector<double> &              mean,
                          const std::vector<std::vector<double>> & frames,
                          double                                   noiseDn2);

} // namespace sensornoise

#endif
