// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FlatPixels_h
#define sensornoise_pixels_FlatPixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstdint>
#include <optional>
#include <vector>

/** \file
 * The pixels by which the first line is drawn, before any is rejected: those in whose flat surroundings motion makes
 * next to no residuals. */

namespace sensornoise
{

class ProjectedVariance;

/** The \a usable pixels of the flatter classes of roughness, in which motion that the series leave makes next to no
 * residuals. */
SensorNoise_EXPORT std::vector<std::uint8_t>
MaskOfFlatClasses(const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & usable,
                  const ParallelFor &               parallelFor);

/** Pixels beyond the levels of the flat ones, for a scene whose flat parts are all dark. Estimator.md, 3.5. */
struct BrighterPixels
{
  std::vector<std::uint8_t> mask;    ///< 1: a flat pixel, or of the flatter half of the pixels of a higher level
  std::vector<std::uint8_t> beyond;  ///< 1: the latter alone
  VarianceLine              through; ///< through the median variances of all levels, without errors
};

/** Finds the pixels of the levels that the \a flat ones, which are usable, do not reach. A line through the flat pixels
 * would be extrapolated to these levels, and reject their pixels by what is not known.
 *
 * Null if the flat pixels reach a level of at least a quarter of the signal of the brightest usable pixels. */
SensorNoise_EXPORT std::optional<BrighterPixels>
FindBrighterPixels(const ProjectedVariance &         projected,
                   const std::vector<std::uint8_t> & usable,
                   const std::vector<std::uint8_t> & flat,
                   const ParallelFor &               parallelFor);

/** Whether the variance of most pixels of \a mask is that of \a line, but for chance: signal lies on one line with the
 * dark pixels, the variance of motion does not. */
SensorNoise_EXPORT bool
FollowsLine(const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask, const VarianceLine & line);

} // namespace sensornoise

#endif
