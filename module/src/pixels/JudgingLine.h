// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_JudgingLine_h
#define sensornoise_pixels_JudgingLine_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/PixelRuns.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
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
    OfRun variance{};
    this->FillVariance(&meanDn, 1, variance);
    return variance[0];
  }
  /** The same at the levels of a run of pixels, in vectors. */
  void
  FillVariance(const double * meanDn, std::size_t pixels, OfRun & variance) const
  {
    const VarianceLine own = line; // which no pointer can point into
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] = own.At(meanDn[i]);
    }
    if (levels.empty())
    {
      return;
    }
    // The ratios, as a sum of what they rise by from each level to the next.
    OfRun ratio{};
    std::fill_n(ratio.begin(), pixels, ratios[0]);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k)
    {
      const double low = levels[k];
      const double high = levels[k + 1];
      const double slope = (ratios[k + 1] - ratios[k]) / (high - low);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        ratio[i] += slope * (std::max(low, std::min(high, meanDn[i])) - low);
      }
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] *= ratio[i];
    }
  }
  /** The levels that the pixels of \a frame are judged at [DN]. */
  const std::vector<double> &
  LevelsOf(const ReferenceFrame & frame) const
  {
    return byNeighbours ? frame.neighbourMean : frame.mean;
  }
  double
  EffectiveFreedom(double freedom, double varianceDn2) const
  {
    return line.EffectiveFreedom(freedom, varianceDn2);
  }
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
