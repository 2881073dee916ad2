// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Scenes_h
#define sensornoise_Scenes_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * Reference images to simulate a burst from, made by program: nothing to download, any size. An image is a vector of
 * doubles, row after row; the scenes below have values in [0, 1]. Each throws std::invalid_argument for a smaller size
 * than it needs. */

namespace sensornoise
{

/** Seed of the scenes: the scene stays the same when only the noise is drawn anew. */
inline constexpr std::uint64_t DefaultSceneSeed = 3;

/** Linear map of the image's own range onto [low, high]. A constant image becomes `high` everywhere. */
SensorNoise_EXPORT std::vector<double>
ScaleToRange(std::vector<double> image, double low, double high);

/** Gaussian blur: sampled kernel of standard deviation `sdPixels`, cut at 4 standard deviations and normalised, edge
 * pixels replicated (as SciPy's `gaussian_filter` with mode "nearest"). 0 leaves the image as it is. */
SensorNoise_EXPORT std::vector<double>
GaussianBlur(const std::vector<double> & image,
             std::size_t                 width,
             std::size_t                 height,
             double                      sdPixels,
             const ParallelFor &         parallelFor = SerialFor);

/** Calibration target: 4 x 4 grey patches on a surround of 0.12, each patch with a margin of 7 % of its cell (at least
 * 2 pixels). The patches hold the 16 levels 0, 1/15, ..., 1 in an order drawn from the seed. Large flat areas: the
 * easy case, like the image "Synthetic" of Sur and Grediac 2015, section 4.2. At least 32 x 32 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTargetScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** Sixteen vertical bars of equal width with the levels 0, 1/15, ..., 1 in a fixed, shuffled order. Every row holds
 * every level, so what differs from row to row (rolling-shutter flicker) stands apart from the scene. At least 16
 * columns; a width that is no multiple of 16 makes bars that differ by one column. */
SensorNoise_EXPORT std::vector<double>
MakeBarsScene(std::size_t width, std::size_t height);

/** Natural-looking texture: dead leaves (discs that hide each other, number of radii in [r, r + dr] proportional to
 * r^-3, random grey: Lee, Mumford and Huang, IJCV 41, 2001, DOI 10.1023/A:1011109015675), each leaf with 1/f value
 * noise of its own strength. Edges of all sizes and few flat areas: the hard case, where vibration reaches most pixels.
 * At least 16 x 16 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTextureScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** An even surface under even light: 1 everywhere. At least 1 x 1 pixel. */
SensorNoise_EXPORT std::vector<double>
MakeFlatScene(std::size_t width, std::size_t height);

} // namespace sensornoise

#endif // sensornoise_Scenes_h
