// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_IlluminationChange_h
#define sensornoise_moments_IlluminationChange_h

#include "SensorNoiseExport.h"

#include <vector>

namespace sensornoise
{

/** Returns the relative standard deviation over time of the illumination factor of frames, from the means of each
 * frame over some cells [1].
 *
 * \a frames holds the cells of each frame [DN], \a mean those of the mean frame, over the same cells. Under another
 * illumination a frame is the mean frame times a factor plus a level. Where the cells differ enough, the factor is the
 * illumination's for any offset. Where they do not, as in a flat field, the factor is not known, but how the level
 * changes is: its change counts as InMoments.strongIlluminationChange where its variance is
 * InMoments.strongChangeOfFlat times \a noiseDn2, that of the pixels' noise, at most [DN^2]. A frame whose difference
 * from the mean frame is mostly another one, noise or another scene, counts as unchanged. */
SensorNoise_EXPORT double
ComputeIlluminationChange(const std::vector<double> &              mean,
                          const std::vector<std::vector<double>> & frames,
                          double                                   noiseDn2);

} // namespace sensornoise

#endif
