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
 * \brief Dependence of the fitted variance line on the gain that corrects the variances.
 *
 * ProjectedVariance adds g k to the variance of a pixel, where k is the skew over its divisor [DN]. A fit of the result
 * has a gain and an intercept that rise by d and e per unit of g. d and e are gain and intercept of the weighted line
 * through k. A few bright frames, whose variation the temporal components mostly remove, make d large: with three
 * illuminated frames of 60 d is 0.3; with one it is 1, because the residual of this frame is 0. The gain that
 * reproduces itself is
 *
 *     g = (g_fit - d g_in) / (1 - d),   intercept = intercept_fit + e (g - g_in),
 *
 * and its error is the error of the fit over 1 - d. Estimator.md, 3.5. */
class SensorNoise_EXPORT GainFeedback
{
public:
  /** No dependence: d = e = 0. */
  GainFeedback() = default;
  /** \a ofGain is d [1], \a ofInterceptDn is e [DN]. */
  GainFeedback(double ofGain, double ofInterceptDn)
    : m_OfGain(ofGain)
    , m_OfIntercept(ofInterceptDn)
  {}
  /** Computes d and e from the pixels of \a mask, with the weights of \a line. */
  GainFeedback(const ProjectedVariance &         projected,
               const VarianceLine &              line,
               const std::vector<std::uint8_t> & mask,
               const ParallelFor &               parallelFor);

  /** Returns d [1]. */
  double
  GetOfGain() const
  {
    return m_OfGain;
  }
  /** Returns whether the absolute value of d is above InPixels.leastFeedback. */
  bool
  IsLarge() const;
  /** Returns the line that reproduces itself, with its covariance. \a fitted was fitted to variances that were computed
   * with \a gainPutIn [DN/e-]. If d is not large, the result is \a fitted. If d is above InPixels.largestFeedback, the
   * gain cannot be determined: it stays, and its standard error becomes larger than any gain that these levels
   * allow. */
  VarianceLine
  SolveFixedPoint(const VarianceLine & fitted, double gainPutIn) const;

private:
  double m_OfGain{ 0.0 };
  double m_OfIntercept{ 0.0 };
};

} // namespace sensornoise

#endif
