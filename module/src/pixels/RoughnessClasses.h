// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_RoughnessClasses_h
#define sensornoise_pixels_RoughnessClasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

class ProjectedSquares;
class ProjectedVariance;
struct InitialNoiseModel;
struct ReferenceFrame;
struct RejectionModel;

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

/** \file
 * Selection of the pixels for the first line, before any pixel is rejected: pixels in flat areas, where motion leaves
 * almost no residuals. */

/** Returns the mask of the \a usable pixels of the flatter roughness classes. Motion that the temporal components do
 * not describe leaves almost no residuals there. */
SensorNoise_EXPORT std::vector<std::uint8_t>
MaskOfFlatClasses(const ProjectedSquares &          squares,
                  const std::vector<std::uint8_t> & usable,
                  const ParallelFor &               parallelFor);

/** Pixels at levels that the flat pixels do not reach, for a scene whose flat areas are all dark. Estimator.md, 3.5. */
struct BrighterPixels
{
  std::vector<std::uint8_t> mask;    ///< 1: a flat pixel, or one of the flatter half of the pixels of a higher level
  std::vector<std::uint8_t> beyond;  ///< 1: a pixel of the mask at a higher level
  VarianceLine              through; ///< line through the median variances at all levels, without errors
};

/** Finds the pixels at the levels that the \a flat pixels, which are usable, do not reach. A line through the flat
 * pixels alone would be extrapolated to these levels, and pixels would be rejected by the error of the extrapolation.
 *
 * Null if the flat pixels reach a quarter of the signal of the brightest usable pixels. */
SensorNoise_EXPORT std::optional<BrighterPixels>
FindBrighterPixels(const ProjectedVariance &         projected,
                   const std::vector<std::uint8_t> & usable,
                   const std::vector<std::uint8_t> & flat,
                   const ParallelFor &               parallelFor);

/** Sets the levels and ratios of \a model to the mean variance over its line of the flatter half of the pixels of \a
 * mask at each level: pixels are then compared with pixels of their own level. Estimator.md, 3.5. */
SensorNoise_EXPORT void
SetRatiosOfLevels(RejectionModel & model, const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask);

/** Returns whether the variance of most pixels of \a mask agrees with \a line within sampling noise. The variance of a
 * signal lies on one line with the variance of the dark pixels; the variance by motion does not. */
SensorNoise_EXPORT bool
AgreesWithLine(const ProjectedVariance & projected, const std::vector<std::uint8_t> & mask, const VarianceLine & line);

} // namespace sensornoise

#endif
