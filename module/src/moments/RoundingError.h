// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_RoundingError_h
#define sensornoise_moments_RoundingError_h

#include <algorithm>
#include <cmath>

namespace sensornoise
{

/** How far rounding to codes moves the mean of values whose variance, that of rounding included, is \a varianceDn2: by
 * up to step/pi exp(-2 pi^2 variance/step^2), the first harmonic, which is nothing once the spread is half a step [DN].
 * Without any noise it is up to half a step, pi/2 times as much. */
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
