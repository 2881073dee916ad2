// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FrameFit_h
#define sensornoise_moments_FrameFit_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Fit of a frame by a level plus a factor times the mean frame, from its means over cells. */
struct FrameFit
{
  double centre{ 0.0 };     ///< mean over the cells of the mean frame [DN]
  double level{ 0.0 };      ///< mean over the cells of the frame [DN]
  double factor{ 0.0 };     ///< factor of the mean frame [1]
  double meanSquare{ 0.0 }; ///< mean square over the cells of the deviation from the fit [DN^2]

  /** Returns the deviation of a cell from the fit [DN]. */
  double
  DifferenceOf(double mean, double frame) const
  {
    return frame - level - factor * (mean - centre);
  }
};

/** Fits the cells \a used of \a frame to \a mean by least squares [DN]. */
SensorNoise_EXPORT FrameFit
FitCells(const std::vector<double> & mean, const std::vector<double> & frame, const std::vector<std::size_t> & used);

/** Fits all cells, then again without the fraction InMoments.fewCells of them that deviates most. */
SensorNoise_EXPORT FrameFit
FitMostCells(const std::vector<double> & mean, const std::vector<double> & frame);

/** Returns the numbers 0 ... count - 1. */
SensorNoise_EXPORT std::vector<std::size_t>
AllBelow(std::size_t count);

/** Returns the relative standard deviation over time of the illumination factor of frames [1], from the means of each
 * frame over some cells.
 *
 * \a frames holds the cells of each frame [DN], \a mean the same cells of the mean frame [DN]. Under another
 * illumination a frame is the mean frame times a factor, plus a level. Where the cells differ enough, this factor is
 * the illumination factor, for any offset. In a flat field the factor is not identifiable, but the change of the level
 * is. It counts as InMoments.strongIlluminationChange where its variance is InMoments.strongChangeOfFlat times
 * \a noiseDn2, an upper bound of the noise variance of the pixels [DN^2]. A frame counts as unchanged if most of its
 * difference from the mean frame is neither a level nor a factor, but noise or another scene. */
SensorNoise_EXPORT double
ComputeIlluminationChange(const std::vector<double> &              mean,
                          const std::vector<std::vector<double>> & frames,
                          double                                   noiseDn2);

} // namespace sensornoise

#endif
