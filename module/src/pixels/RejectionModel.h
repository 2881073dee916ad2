// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_RejectionModel_h
#define sensornoise_pixels_RejectionModel_h

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

/** Rejection model: the variance that pixels are tested against. It is a line times the deviation from the line that
 * the whole sensor has, for example by a non-linear response, and it includes the dispersion of the noise from pixel to
 * pixel. Pixels are not rejected for these. */
struct SensorNoise_EXPORT RejectionModel
{
  VarianceLine        line;   ///< the line, with the dispersion of the noise from pixel to pixel
  std::vector<double> levels; ///< levels in rising order [DN]; empty: the model is the line
  std::vector<double> ratios; ///< variance over the line at these levels [1]
  bool byNeighbours{ false }; ///< true: a pixel's level is its neighbours' mean, because its own offset is not signal
  /** Variance inflation of the mean of many pixels by the spatial noise correlation: the sum over all lags of the
   * squared correlation coefficients [1]. */
  double varianceInflation{ 1.0 };

  /** Returns the expected variance at the level \a meanDn [DN^2]. */
  double
  At(double meanDn) const
  {
    OfRun variance{};
    this->FillVariance(&meanDn, 1, variance);
    return variance[0];
  }
  /** Sets \a variance to the expected variance at the levels of \a pixels pixels, at most PixelsPerRun, with SIMD
   * instructions [DN^2]. */
  void
  FillVariance(const double * meanDn, std::size_t pixels, OfRun & variance) const
  {
    const VarianceLine own = line; // a copy that no pointer can alias, which SIMD instructions need
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] = own.At(meanDn[i]);
    }
    if (levels.empty())
    {
      return;
    }
    // The ratio is interpolated as a sum of its increments from each level to the next.
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
  /** Returns the levels of the pixels of \a frame at which they are tested [DN]. */
  const std::vector<double> &
  LevelsOf(const ReferenceFrame & frame) const
  {
    return byNeighbours ? frame.neighbourMean : frame.mean;
  }
  /** Returns the degrees of freedom of a pixel's variance, reduced by the dispersion of the noise from pixel to
   * pixel. */
  double
  EffectiveDof(double dof, double varianceDn2) const
  {
    return line.EffectiveDof(dof, varianceDn2);
  }
};

/** Measures the deviation of the whole sensor from \a line. The sensor deviates everywhere, moving objects do so in
 * places. Therefore the frame is divided into tiles of 16 x 16 pixels, which are sorted into up to 16 bins of the
 * level. The deviation in a bin is the median excess of its smoother half of tiles. The dispersion of the noise from
 * pixel to pixel is the median over the dark tiles.
 *
 * The result is \a line alone if no deviation exceeds InPixels.leastDeviation by Significance.hint standard errors.
 * \a blackDn is as in EstimateFixedPattern(). */
SensorNoise_EXPORT RejectionModel
FitRejectionModel(const VarianceLine &              line,
                  const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & mask,
                  double                            blackDn,
                  const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
