// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_SeriesSums_h
#define sensornoise_emva1288_SeriesSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/Emva1288.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * Parts of the statistics of the frames of one exposure, EmvaSeries: spatial variances and highpass filter. */

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

/** Pixels between the centre and the end of the lowpass kernel: 3 of the box of 7, 5 of the box of 11, and 1 of the
 * binomial mask of 3. */
inline constexpr std::size_t EmvaFilterRadius = 9;

/** Image after the highpass filter, row after row [DN]. */
struct HighpassImage
{
  std::size_t         columns{ 0 };
  std::size_t         rows{ 0 };
  std::vector<double> pixels;
};

/** Returns the weights of the lowpass filter along one axis, whose sum is 1: a box of 7, a box of 11 and the binomial
 * mask 1 2 1, one after the other. */
SensorNoise_EXPORT const std::array<double, 2 * EmvaFilterRadius + 1> &
EmvaLowpassKernel();

/** Returns whether the filter leaves three or more columns and rows of a frame. */
bool
HasRoomForHighpass(std::size_t width, std::size_t height);

/** Applies the highpass filter of EMVA Standard 1288, Release 4.0 Linear, section 8.1: the image minus its lowpass.
 *
 * The lowpass filter is a box of 7 x 7 pixels, a box of 11 x 11 and a binomial mask of 3 x 3. It suppresses the uneven
 * illumination. Only pixels whose neighbourhood of 19 x 19 pixels is in the image are kept: the filter is the same for
 * all of them. \a image has \a width x \a height pixels and room for the filter (HasRoomForHighpass()). */
SensorNoise_EXPORT HighpassImage
FilterHighpass(const std::vector<double> & image,
               std::size_t                 width,
               std::size_t                 height,
               const ParallelFor &         parallelFor = SerialFor);

} // namespace sensornoise

#endif
