// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_LocalFlicker_h
#define sensornoise_pixels_LocalFlicker_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

struct PixelLight;

/** Sums from which the spread of local light follows for any offset. */
struct SensorNoise_EXPORT LocalFlicker
{
  double energy{ 0.0 }; ///< sum of (sum_j S_j^2 - noise) / noise
  double w{ 0.0 };      ///< of w, w I and w I^2, I the mean minus the centre
  double wI{ 0.0 };
  double wII{ 0.0 };
  double frames{ 0.0 };

  /** Root mean square over the frame of the standard deviation over time of the light, relative to its mean:
   * sqrt(sum w (sum_j S_j^2 - noise) / ((T - 1) sum w q^2)), q the mean above the offset (minus the centre). */
  double
  Sd(double offset) const;
};

/** The sums over the pixels of the mask. */
SensorNoise_EXPORT LocalFlicker
SumLocalFlicker(const PixelLight & data);

} // namespace sensornoise

#endif
