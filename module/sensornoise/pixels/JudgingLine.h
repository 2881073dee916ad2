// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_JudgingLine_h
#define sensornoise_pixels_JudgingLine_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class ProjectedVariance;

/** The variance that pixels are judged by: a line, and what the sensor itself departs from it by, which no pixel is
 * blamed for: a response that bends, pixels that are noisier than others in the dark. */
struct SensorNoise_EXPORT JudgingLine
{
  VarianceLine        line;
  std::vector<double> levels; ///< rising [DN]; empty: the line as it is
  std::vector<double> ratios; ///< variance over line at these levels [1]
  bool byNeighbours{ false }; ///< whether a pixel's level is its neighbours' mean: its own offset is no light
  /** By how much more the mean variance of many pixels scatters than if they shared no noise: the sum over all lags of
   * the squared correlation coefficients [1]. */
  double sharedSquares{ 1.0 };

  double
  At(double meanDn) const
  {
    return levels.empty() ? line.At(meanDn) : line.At(meanDn) * this->RatioAt(meanDn);
  }
  /** The level that pixel \a p of \a frame is judged at [DN]. */
  double
  LevelOf(const ReferenceFrame & frame, std::size_t p) const
  {
    return byNeighbours ? frame.neighbourMean[p] : frame.mean[p];
  }
  double
  EffectiveFreedom(double freedom, double varianceDn2) const
  {
    return line.EffectiveFreedom(freedom, varianceDn2);
  }

private:
  double
  RatioAt(double meanDn) const;
};

/** Finds what the sensor departs from \a line by. What a sensor does it does everywhere, things that move are in
 * places: the frame is parted into squares of 16 x 16 pixels, and the medians of their mean variance over the line, of
 * the smoother half in each of up to 16 bins of the intensity, are the departure; the median scatter in the dark
 * squares is the pixels' own noise. Departures of less than 1 % are left to the line. \a blackDn as of
 * MeasureLevelPattern(). */
SensorNoise_EXPORT JudgingLine
MakeJudgingLine(const VarianceLine &              line,
                const ProjectedVariance &         projected,
                const std::vector<std::uint8_t> & mask,
                double                            blackDn,
                const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
