// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_VibrationMask_h
#define sensornoise_published_VibrationMask_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Centred differences of a frame-sized map at an inner pixel [DN/pixel], (3.1) of Sur & Gredi\'ac 2015. */
struct Gradient
{
  double x;
  double y;
};

inline Gradient
CentredGradient(const double * map, std::size_t width, std::size_t p)
{
  return { 0.5 * (map[p + 1] - map[p - 1]), 0.5 * (map[p + width] - map[p - width]) };
}

/** The quantile that a chi-square variable of 2 degrees of freedom exceeds with probability \a level: -2 ln(level).
 * 1 % gives 9.21, the paper's figure. Throws std::invalid_argument unless 0 < level < 1. */
SensorNoise_EXPORT double
ChiSquare2Quantile(double level);

/** The test of section 3.1 for \a count neighbouring inner pixels of a row: sets \a kept to 1 where
 * 2 T |grad ubar|^2 < quantile var(u). \a stride is the distance to the next row of \a mean. \a valid may be null. */
SensorNoise_EXPORT void
TestVibrationOfRow(const double *       mean,
                   std::ptrdiff_t       stride,
                   const double *       variance,
                   const std::uint8_t * valid,
                   std::size_t          count,
                   std::size_t          frames,
                   double               quantile,
                   std::uint8_t *       kept);

/** Marks the pixels whose gradient noise alone explains, so that vibrations leave their variance alone.
 *
 * Section 3.1 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035): where E(u) is locally constant,
 * 2 T |grad ubar|^2 / var(u) follows a chi-square law of 2 degrees of freedom. A pixel is kept (1) if that is below the
 * quantile of \a level. Not kept (0): pixels on the border, which have no centred difference, pixels that are not
 * \a valid (null: all are), pixels that never vary, and pixels beside one that is not finite.
 *
 * The variance is the temporal one as it is, flicker included, as in the paper. */
SensorNoise_EXPORT std::vector<std::uint8_t>
VibrationMask(const double *       mean,
              const double *       variance,
              const std::uint8_t * valid,
              std::size_t          width,
              std::size_t          height,
              std::size_t          frames,
              double               level,
              const ParallelFor &  parallelFor = SerialFor);

} // namespace sensornoise

#endif
