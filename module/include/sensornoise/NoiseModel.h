// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_NoiseModel_h
#define sensornoise_NoiseModel_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** The variance of a pixel as a function of its level x: a x + b [DN^2]. All that a denoiser needs of a sensor: offset
 * and read noise are inside b = sigma^2 - a mu, so that neither has to be known. */
struct SensorNoise_EXPORT NoiseModel
{
  double varianceSlopeDn{ 0.0 };   ///< a, `variance_slope` of a report [DN/e-]; above 0
  double totalInterceptDn2{ 0.0 }; ///< b, `total_intercept` of a report [DN^2]; of either sign

  /** The variance at a level [DN^2]. */
  double
  VarianceAt(double levelDn) const
  {
    return varianceSlopeDn * levelDn + totalInterceptDn2;
  }

  /** Throws std::invalid_argument unless the slope is finite and above 0 and the intercept finite. */
  void
  Validate() const;
};

/** The model of a report. Nothing else of it is asked for: a report without offset serves, and so does one of frames
 * that were smoothed. Throws std::invalid_argument where one of the two has no value, or the slope is not above 0. */
SensorNoise_EXPORT NoiseModel
NoiseModelOf(const Report & report);

} // namespace sensornoise

#endif
