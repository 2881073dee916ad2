// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FarVariance_h
#define sensornoise_pixels_FarVariance_h

#include "sensornoise/pixels/Constants.h"

#include <cmath>

namespace sensornoise
{

/** Whether a chi-square variable over its \a freedom is farZ standard deviations above 1 or more: its cube root is
 * about normal (Wilson & Hilferty 1931). */
inline bool
IsFarAbove(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s + InPixels.farZ * std::sqrt(s);
  return !(ratio < limit * limit * limit);
}
/** The same on either side. */
inline bool
IsFarOff(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s - InPixels.farZ * std::sqrt(s);
  return IsFarAbove(ratio, freedom) || !(ratio > limit * limit * limit);
}

} // namespace sensornoise

#endif
