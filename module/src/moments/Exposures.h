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

/** Throws std::invalid_argument unless all exposures are finite and 0 or more, and at least 3 of them differ. A line
 * passes through any two levels, so that two levels contain no information about linearity. An empty list, no
 * exposures, is allowed. */
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
  double      pixelNoiseDn2{ 0.0 }; ///< variance of the level of one frame due to the noise of its pixels
  double      patternDn2{ 0.0 };    ///< variance of the mean due to differences between cells, including noise
};

/** Returns the levels of the brightest cells of the frames by exposure, in rising order.
 *
 * The signal of a cell is the rise of its mean from the lowest to the highest exposure, so that it contains no offset.
 * The brightest cells are those near the quantile 0.95 of the signal (MomentsConstants): almost all cells of a flat
 * field, or the brightest places of a scene, where the levels cover the largest range. Cells with a clipped pixel (0
 * in \a valid, of a frame's size) are left out, unless the remaining cells have less than half of the signal. A flat
 * field driven into saturation is clipped everywhere, and its saturated levels are outside of the range of EMVA 1288.
 *
 * The noise of pixels moves each cell independently, the illumination moves all cells together. The scatter over time
 * of the cells about their common motion, divided by their number, is therefore \c pixelNoiseDn2. For an exposure with
 * a single frame it is estimated from the differences of neighbouring pixels, an upper bound.
 *
 * \a counted holds the frames that are counted, \a exposures the exposures of all frames. The result is empty if fewer
 * than two cells are finite. */
SensorNoise_EXPORT std::vector<ExposureLevel>
FindExposureLevels(const FrameThumbnails &           thumbnails,
                   const std::vector<std::size_t> &  counted,
                   const std::vector<double> &       exposures,
                   const std::vector<std::uint8_t> & valid);

class FrameThumbnails;
struct StackMaps;

/** Returns a mask of the frame: the valid pixels near the largest signal at which whole cells of \a thumbnails are
 * uniform.
 *
 * The mean level of pixels with different signals has a larger curvature than the response at their mean signal. For a
 * quadratic response the factor is 1 + (relative variance of the signals). In textured cells this is 10 %. The signal
 * S is therefore lowered step by step from the brightest cells, until 4 cells hold only pixels with signals from S /
 * 1.25 to 1.25 S. Where S falls below half of the brightest signal, all valid pixels are returned.
 *
 * The signal is the level minus the level at exposure 0, which follows from the mean levels of the cells at the lowest
 * and the highest exposure.
 * \param exposures exposures of all frames
 * \param counted numbers of the frames that are counted */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindEvenPixels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures,
               const StackMaps &                maps);

} // namespace sensornoise

#endif
