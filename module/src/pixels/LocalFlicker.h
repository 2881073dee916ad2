// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_LocalFlicker_h
#define sensornoise_pixels_LocalFlicker_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

struct IlluminationResponses;

/** Sums that give the standard deviation over time of local illumination for any offset. */
struct SensorNoise_EXPORT LocalFlicker
{
  double energy{ 0.0 }; ///< sum over the pixels of sum_j (S_j^2 / noise - 1), over the illumination components j [1]
  double w{ 0.0 };      ///< sum of the weights w = 1 / noise [1/DN^2]
  double wI{ 0.0 };     ///< sum of w I, where I is the mean minus the centre [1/DN]
  double wII{ 0.0 };    ///< sum of w I^2 [1]
  double frames{ 0.0 }; ///< number of frames T

  /** Returns the root mean square over the frame of the standard deviation of the illumination over time, relative to
   * its mean [1]: sqrt(sum w sum_j (S_j^2 - noise) / ((T - 1) sum w q^2)), where q is the mean above \a offset.
   * \a offset is relative to the centre [DN]. */
  double
  Sd(double offset) const;
};

/** Computes the sums over the pixels of the mask. */
SensorNoise_EXPORT LocalFlicker
SumLocalFlicker(const IlluminationResponses & data);

} // namespace sensornoise

#endif
