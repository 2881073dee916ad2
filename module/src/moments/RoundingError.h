// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_RoundingError_h
#define sensornoise_moments_RoundingError_h

#include <algorithm>
#include <cmath>

namespace sensornoise
{

/** Returns the largest shift by rounding to codes of the mean of values with the variance \a varianceDn2, quantization
 * noise included [DN]. It is step/pi exp(-2 pi^2 variance/step^2), the first harmonic, where the variance is without
 * quantization noise. The shift is negligible if the standard deviation is half a step or more. Without any noise the
 * shift is up to half a step, pi/2 times this value. */
inline double
RoundingErrorDn(double stepDn, double varianceDn2)
{
  if (stepDn == 0.0)
  {
    return 0.0;
  }
  constexpr double pi = 3.14159265358979323846;
  const double     hidden = std::max(0.0, varianceDn2 / (stepDn * stepDn) - 1.0 / 12.0);
  return stepDn / pi * std::exp(-2.0 * pi * pi * hidden);
}

} // namespace sensornoise

#endif
