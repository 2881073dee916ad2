// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FrameFit_h
#define sensornoise_moments_FrameFit_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** A frame as a level plus a factor times the mean frame, by its means over cells. */
struct FrameFit
{
  double centre{ 0.0 }; ///< mean over the cells of the mean frame [DN]
  double level{ 0.0 };  ///< mean over the cells of the frame [DN]
  double factor{ 0.0 }; ///< [1]
  double misfit{ 0.0 }; ///< mean square over the cells of the difference [DN^2]

  /** How far a cell is from the fit [DN]. */
  double
  DifferenceOf(double mean, double frame) const
  {
    return frame - level - factor * (mean - centre);
  }
};

/** Fits by least squares over the cells \a used of \a mean and \a frame [DN]. */
SensorNoise_EXPORT FrameFit
FitCells(const std::vector<double> & mean, const std::vector<double> & frame, const std::vector<std::size_t> & used);

/** Fits all cells, and then those again that differ least: all but InMoments.fewCells of them. */
SensorNoise_EXPORT FrameFit
FitMostCells(const std::vector<double> & mean, const std::vector<double> & frame);

/** 0 ... count - 1. */
SensorNoise_EXPORT std::vector<std::size_t>
AllBelow(std::size_t count);

} // namespace sensornoise

#endif
