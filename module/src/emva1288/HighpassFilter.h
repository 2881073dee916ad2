// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_HighpassFilter_h
#define sensornoise_emva1288_HighpassFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

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
