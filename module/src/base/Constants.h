// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constants_h
#define sensornoise_base_Constants_h

#include "base/Constant.h"

namespace sensornoise
{

/** Numbers that several components use. Numbers of one component are in its own Constants.h. */
struct CommonConstants
{
  /** Quantiles of the mean that represent the darkest and the brightest level [1]. Chosen empirically: 130 of 65536
   * pixels lie beyond either, so that a single defect is not taken for a level. */
  double darkestQuantile{ 0.002 };
  double brightestQuantile{ 0.998 };

  /** Largest relative error of a number that is reported [1]: with more it is an order of magnitude. Chosen
   * empirically. The error is relative to the expected size, not to the estimate, so that a number is not reported
   * because it happens to be large. */
  double largestRelativeError{ 0.25 };

  /** Largest signal of a dark level, as a fraction of the signal of the brightest levels [1]. At levels of 20 to 80 % a
   * gamma of 1.3 deviates from a line by 2 %, and has half the gain. */
  double darkFraction{ 0.1 };

  /** Least difference of the variances without signal, relative to the larger one, that counts [1]. Chosen by the size
   * of the effect: 5 % of the read noise. */
  double leastDarkDifference{ 0.1 };

  /** Fraction of the pixels of a neighbourhood far above the expected variance, from which the whole neighbourhood does
   * not fit [1]. Chosen empirically. */
  double largestOutlierFraction{ 0.15 };

  /** Least fraction of its pixels that a tile or cell needs [1]. Chosen empirically. */
  double leastCoveredFraction{ 0.25 };

  /** Smallest ratio of a variance to its expectation from the line [1]: a variance is above 0. Chosen empirically. */
  double leastVarianceRatio{ 0.1 };

  /** Noise variance, relative to the square of the quantization step, below which quantization hides the noise [1]: the
   * variance for a noise of half a step. */
  double hiddenVariance{ 0.25 };

  /** Difference of chi-squares, or of Schwarz' criterion, that is very strong evidence (Kass & Raftery 1995, on the
   * scale of 2 ln B) [1]. */
  double strongEvidence{ 10.0 };
};

SENSORNOISE_CONSTANT CommonConstants InCommon;

} // namespace sensornoise

#endif
