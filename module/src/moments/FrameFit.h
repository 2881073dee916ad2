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
  double centre{ 0.0 }; ///< mean over the cells of the mean frame [DN]
  double level{ 0.0 };  ///< mean over the cells of the frame [DN]
  double factor{ 0.0 }; ///< factor of the mean frame [1]
  double misfit{ 0.0 }; ///< mean square over the cells of the deviation from the fit [DN^2]

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

} // namespace sensornoise

#endif
