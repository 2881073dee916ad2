// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceStep_h
#define sensornoise_pixels_VarianceStep_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceCurve.h"

#include <optional>
#include <vector>

namespace sensornoise
{

/** \class VarianceStep
 * \brief Two parallel lines of the variance, one below and one above a level, as for pixels with two amplifiers that
 * each serve a range of levels. Estimator.md, 3.16. */
struct SensorNoise_EXPORT VarianceStep
{
  double levelDn{ 0.0 };     ///< level of the step [DN]
  double halfWidthDn{ 0.0 }; ///< half width of the interval about it in which pixels may be of either amplifier [DN]
  /** Variance by the line above the step minus variance by the line below, at one level [DN^2]. */
  double sizeDn2{ 0.0 };
  double errorDn2{ 0.0 }; ///< standard error of sizeDn2 [DN^2]
  /** The line below the step. Its slope is common to both lines; its covariance is for (gain, intercept). */
  VarianceLine line;
  /** Excess over the common slope below the step and above it [DN/e-], estimated from the levels and
   * InSteps.priorOfGains together, and the larger of their standard errors [DN/e-]. */
  double slopeBelow{ 0.0 };
  double slopeAbove{ 0.0 };
  double errorOfSlopes{ 0.0 };

  /** Returns the deviations of \a curve, in which the step was found, from the two lines, without the levels about the
   * step. */
  VarianceCurve
  RestOf(const VarianceCurve & curve) const;
};

/** Finds a step of the variance, up or down. Null if there is none, if it is small, or if a smooth curve or a broken
 * line of as many parameters describes the variance as well. */
SensorNoise_EXPORT std::optional<VarianceStep>
FindVarianceStep(const VarianceCurve & curve);

} // namespace sensornoise

#endif
