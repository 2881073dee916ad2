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
 * \brief Two parallel lines of the variance, one below and one above a level, as of pixels with two amplifiers, each
 * for a part of the levels. Estimator.md, 3.16. */
struct SensorNoise_EXPORT VarianceStep
{
  double levelDn{ 0.0 };
  double halfWidthDn{ 0.0 }; ///< of the levels about it at which pixels may be of either amplifier [DN]
  double sizeDn2{ 0.0 };     ///< variance above the step less that of the line below, at one level [DN^2]
  double errorDn2{ 0.0 };
  /** The line of the levels below the step. Its slope is that of both; its covariance is of gain and intercept. */
  VarianceLine line;
  /** By how much the slope below the step and that above it exceed the common one [DN/e-], of what the levels and
   * InSteps.priorOfGains say together, and the larger error of both [DN/e-]. */
  double slopeBelow{ 0.0 };
  double slopeAbove{ 0.0 };
  double errorOfSlopes{ 0.0 };

  /** The departures of \a curve, in which the step was found, from the two lines; without the levels about the step. */
  VarianceCurve
  RestOf(const VarianceCurve & curve) const;
};

/** Finds a step of the variance, of whatever sign; null: the variance has none, or it is small, or a smooth curve or a
 * bend of as many parameters describes the variance as well. */
SensorNoise_EXPORT std::optional<VarianceStep>
FindVarianceStep(const VarianceCurve & curve);

} // namespace sensornoise

#endif
