// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_Constants_h
#define sensornoise_single_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** Numbers of the single-image method. "Chosen empirically" is on simulated frames of 384 x 384 and 512 x 512 pixels:
 * the scenes target, bars and texture, ramps, smooth fields, and fields with power spectra f^-2 to f^-5. */
struct SingleConstants
{
  /** \name Level sets */
  ///@{
  /** Level sets of a frame, of equal width in level. Chosen empirically. */
  std::size_t levelSets{ 64 };
  /** Largest variance of the approximation in a window, relative to the variance of the noise there, of a window
   * without edges [1]. Chosen empirically. */
  double largestRoughness{ 1.6 };
  /** Fewest detail coefficients of a level set that is fitted. Chosen: its variance is known to 40 %. */
  double leastOfLevelSet{ 30.0 };
  ///@}

  /** \name Starting line */
  ///@{
  /** Largest number of positions of the sample for the starting line. Chosen for the time: 1 % of a frame of 24
   * megapixels. */
  std::size_t samplePositions{ std::size_t{ 1 } << 18 };
  /** Every n-th position of the sample is sorted by level. */
  std::size_t sortedStride{ 4 };
  /** Groups of equal count, from dark to bright. Chosen empirically. */
  std::size_t startingGroups{ 16 };
  /** Smallest variance that the first selection assumes, relative to the median of the groups [1]. Chosen empirically:
   * a line that starts below 0 selects no dark windows. */
  double leastStartingVariance{ 0.05 };
  ///@}

  /** \name Fit */
  ///@{
  /** Smallest probability that a pixel of a level set is between the clip levels [1]: below, the variance of the
   * clipped pixels depends more on the tails of the noise than on its variance. Chosen empirically. */
  double leastUnclipped{ 0.9 };
  /** Largest relative residual of a level set that pulls the line [1]. Chosen: a level set of 30 coefficients passes 3
   * by texture alone. */
  double largestResidual{ 3.0 };
  /** Steps of Fisher scoring, at most. Chosen: it ends the fit where it does not converge. */
  int fitSteps{ 40 };
  /** Coefficients below which no line is given. Chosen empirically: with fewer, the gains of textured frames were off
   * by more than twice their errors. */
  double leastCoefficients{ 1000.0 };
  ///@}

  /** \name Texture */
  ///@{
  /** Fraction of the windows without edges below which texture dominates [1], and below which it dominates if the
   * relative error of the gain is above largestErrorInTexture. Chosen empirically: where the gain was off by more than
   * 10 %, one of these warnings or the next ones stood beside it. */
  double leastEvenFraction{ 0.1 };
  double leastEvenFractionIfUncertain{ 0.5 };
  double largestErrorInTexture{ 0.03 };
  /** Excess of the variance of the horizontal and vertical details over the diagonal ones [1]; 0 in white noise. Chosen
   * empirically: texture has more of its power in the former. */
  double largestBandExcess{ 0.05 };
  /** Size of the correlation of neighbouring diagonal details above which they are not white [1]; 0 in white noise.
   * Chosen empirically: a weave that raises the gain by 10 % has 0.06. */
  double largestDetailCorrelation{ 0.03 };
  /** Reduced chi-square of the line above which the variance is no line of the level [1]. Chosen empirically: a PRNU of
   * 1 % that raises the gain by 15 % gives 5. */
  double largestReducedChi2{ 2.0 };
  /** Part of the variance of single frames that does not average out in their mean [1]. Chosen by the size of the
   * effect. */
  double largestFixedPart{ 0.1 };
  ///@}
};

SENSORNOISE_CONSTANT SingleConstants InSingle;

} // namespace sensornoise

#endif
