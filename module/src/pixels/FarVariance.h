// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FarVariance_h
#define sensornoise_pixels_FarVariance_h

#include "base/Significance.h"

#include <cmath>

namespace sensornoise
{

/** Where a chi-square variable over its \a freedom is far off 1 (Significance.manyTests): its cube root is about normal
 * (Wilson & Hilferty 1931). */
struct FarLimits
{
  double low;
  double high;

  explicit FarLimits(double freedom)
  {
    const double s = 2.0 / (9.0 * freedom);
    const double far = Significance.manyTests * std::sqrt(s);
    const double above = 1.0 - s + far;
    const double below = 1.0 - s - far;
    low = below * below * below;
    high = above * above * above;
  }
};

} // namespace sensornoise

#endif
