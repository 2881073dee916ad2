// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FarVariance_h
#define sensornoise_pixels_FarVariance_h

#include "base/Significance.h"

#include <cmath>

namespace sensornoise
{

/** Limits beyond which a chi-square variable over its degrees of freedom deviates from 1 by more than
 * Significance.manyTests standard deviations. The cube root of the variable is about normal (Wilson & Hilferty
 * 1931). */
struct FarLimits
{
  double low;  ///< lower limit [1]
  double high; ///< upper limit [1]

  /** Computes the limits for \a freedom degrees of freedom, above 0. */
  explicit FarLimits(double dof)
  {
    const double s = 2.0 / (9.0 * dof);
    const double far = Significance.manyTests * std::sqrt(s);
    const double above = 1.0 - s + far;
    const double below = 1.0 - s - far;
    low = below * below * below;
    high = above * above * above;
  }
};

} // namespace sensornoise

#endif
