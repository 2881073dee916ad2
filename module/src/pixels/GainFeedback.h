// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainFeedback_h
#define sensornoise_pixels_GainFeedback_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

class ProjectedVariance;

/** \class GainFeedback
 * \brief By how much the line of the variance follows the gain that its own correction was made with.
 *
 * ProjectedVariance adds g k to the variance of a pixel, k the skew over its divisor [DN]. The fit of the result is a
 * line whose gain and intercept rise by d and e per unit of g: those of the weighted line through k. Few bright frames,
 * which the series take much of, make d large: with three lit frames of 60 it is 0.3, with one it is 1, for its
 * residual is 0. The gain that reproduces itself is
 *
 *     g = (g_fit - d g_in) / (1 - d),   intercept = intercept_fit + e (g - g_in),
 *
 * and its error is that of the fit over 1 - d. Estimator.md, 3.5. */
class SensorNoise_EXPORT GainFeedback
{
public:
  /** None. */
  GainFeedback() = default;
  GainFeedback(double ofGain, double ofInterceptDn)
    : m_OfGain(ofGain)
    , m_OfIntercept(ofInterceptDn)
  {}
  /** Of the pixels of \a mask, with the weights of \a line. */
  GainFeedback(const ProjectedVariance &         projected,
               const VarianceLine &              line,
               const std::vector<std::uint8_t> & mask,
               const ParallelFor &               parallelFor);

  /** d [1]. */
  double
  GetOfGain() const
  {
    return m_OfGain;
  }
  /** Whether d is above InPixels.leastFeedback. */
  bool
  IsLarge() const;
  /** The line that reproduces itself, with its covariance, from a \a fitted one whose variances were computed with
   * \a gainPutIn. Where d is above InPixels.largestFeedback, no line does: then the gain stays, and its standard error
   * is larger than any gain of these levels. Without a large d the line is as it was. */
  VarianceLine
  Settle(const VarianceLine & fitted, double gainPutIn) const;

private:
  double m_OfGain{ 0.0 };
  double m_OfIntercept{ 0.0 };
};

} // namespace sensornoise

#endif
