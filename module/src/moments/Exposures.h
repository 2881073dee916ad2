// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Exposures_h
#define sensornoise_moments_Exposures_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class FrameThumbnails;

/** Throws std::invalid_argument unless all exposures are finite and 0 or more, and at least 3 of them differ: a line
 * passes through any two levels, so that two say nothing about linearity. An empty list, no exposures, is allowed. */
SensorNoise_EXPORT void
ValidateExposures(const std::vector<double> & exposures);

/** Throws std::invalid_argument unless there is one exposure for each of the \a frames, or none at all. */
SensorNoise_EXPORT void
RequireExposuresOfFrames(const std::vector<double> & exposures, std::size_t frames);

/** The level of some pixels in all frames of one exposure. */
struct ExposureLevel
{
  double      exposure{ 0.0 };      ///< in the user's unit, 0: a dark frame
  std::size_t frames{ 0 };          ///< different frames of this exposure
  double      meanDn{ 0.0 };        ///< mean over pixels and frames
  double      squaresDn2{ 0.0 };    ///< sum over the frames of (level of the frame - meanDn)^2
  double      pixelNoiseDn2{ 0.0 }; ///< variance of the level of one frame that the noise of its pixels makes
  double      patternDn2{ 0.0 };    ///< variance of the mean that differences between cells make, noise included
};

/** Returns the levels by exposure, in rising order, of the brightest cells of the frames.
 *
 * The signal of a cell is what its mean rises by from the lowest to the highest exposure, which holds no offset. The
 * brightest cells are those with nearly the signal of the quantile 0.95 (MomentsConstants): almost all of a flat field,
 * the brightest places of a scene, where the levels cover the largest range. Cells with a clipped pixel (0 in \a valid,
 * of a frame's size) are left out, unless what is left reaches less than half as far: a flat field that is driven into
 * saturation is clipped everywhere, and its saturated levels are outside of the range that EMVA 1288 takes.
 *
 * The noise of pixels moves each cell by itself, the illumination moves all of them together. So the scatter over time
 * of the cells about their common motion, over their number, is \c pixelNoiseDn2; of an exposure with a single frame it
 * is what neighbouring pixels differ by, an upper bound.
 *
 * \a counted are the frames that count, \a exposures those of all frames. Empty if fewer than two cells are finite. */
SensorNoise_EXPORT std::vector<ExposureLevel>
FindExposureLevels(const FrameThumbnails &           thumbnails,
                   const std::vector<std::size_t> &  counted,
                   const std::vector<double> &       exposures,
                   const std::vector<std::uint8_t> & valid);

} // namespace sensornoise

#endif
