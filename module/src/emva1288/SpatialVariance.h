// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_SpatialVariance_h
#define sensornoise_emva1288_SpatialVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Emva1288.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Returns the spatial variances of a mean image, with their parts of columns, rows and pixels, (35) to (42).
 *
 * A variance is the mean square of the deviations from the mean, with the number of pixels as divisor (35). The parts
 * solve the three equations of (42): the variance of the means of columns contains the pixels' part over the number of
 * rows, the variance of the means of rows the pixels' part over the number of columns, and the sum of all three is the
 * total variance.
 * \param mean mean image of the frames, row after row [DN]
 * \param columns columns of the image, 3 or more [pixel]
 * \param rows rows of the image, 3 or more [pixel]
 * \param stackDn2 temporal variance of a pixel in one frame (65) [DN^2]
 * \param frames number of frames of the mean */
SensorNoise_EXPORT EmvaSpatialVariance
MeasureSpatialVariance(const std::vector<double> & mean,
                       std::size_t                 columns,
                       std::size_t                 rows,
                       double                      stackDn2,
                       std::size_t                 frames);

} // namespace sensornoise

#endif
