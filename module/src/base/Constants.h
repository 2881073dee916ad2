// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constants_h
#define sensornoise_base_Constants_h

#include "base/Constant.h"

namespace sensornoise
{

/** Numbers that several rooms use. Those of one room are in its own Constants.h. */
struct CommonConstants
{
  /** Quantiles of the mean that stand for the darkest and the brightest level [1]. Set by hand: 130 of 65536 pixels lie
   * beyond either, so that no single defect is a level. */
  double darkestQuantile{ 0.002 };
  double brightestQuantile{ 0.998 };

  /** Largest relative error of a number that is given [1]: with more it is an order of magnitude. Set by hand. The
   * error is relative to the expected size, not to the estimate: no number is given because it came out large. */
  double largestRelativeError{ 0.25 };

  /** Part of the light of the brightest levels above the offset up to which a level is dark [1]: at levels of 20 to 80
   * % a gamma of 1.3 departs from a line by 2 %, and has half the gain. */
  double darkShare{ 0.1 };

  /** Difference of the variances without signal, relative to the larger one, from which on it counts [1]. Chosen by the
   * size of the effect: 5 % of the read noise. */
  double leastDarkDifference{ 0.1 };

  /** Share of the pixels of a neighbourhood far above the expected variance from which on all of it does not fit [1].
   * Set by hand. */
  double largestFarShare{ 0.15 };

  /** Share of its pixels that a tile or cell needs [1]. Chosen empirically. */
  double leastCoveredShare{ 0.25 };

  /** Smallest ratio of a variance to the line that is expected of it [1]: a variance is above 0. Set by hand. */
  double leastVarianceRatio{ 0.1 };

  /** Variance of the noise, relative to the square of the code step, below which the codes hide it [1]: that of half a
   * step. */
  double hiddenVariance{ 0.25 };

  /** Difference of chi-squares, or of Schwarz' criterion, that is very strong evidence (Kass & Raftery 1995, on the
   * scale of 2 ln B) [1]. */
  double strongEvidence{ 10.0 };
};

SENSORNOISE_CONSTANT CommonConstants InCommon;

} // namespace sensornoise

#endif
