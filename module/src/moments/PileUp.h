// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_PileUp_h
#define sensornoise_moments_PileUp_h

#include "base/Constants.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** \file
 * Pile-up: saturation level found from repeated extreme values. Noise alone makes the outermost level the extreme of
 * few pixels, of fewer than the levels inside. At a clip level, the extremes of all pixels that would exceed it
 * accumulate. */

/** Returns whether the \a atEnd pixels whose extreme is the outermost level are a pile-up: at least 8, and more than 3
 * times \a mostInside. \a mostInside is the largest number of pixels on one of the levels inside. */
inline bool
IsPileUp(std::size_t atEnd, std::size_t mostInside)
{
  return atEnd >= std::max(InMoments.fewestPixelsOfPileUp, InMoments.pileUpRatio * mostInside + 1);
}

/** Distance of the outermost levels from the mean of the pixels that attain them, in temporal standard deviations of
 * these pixels: the median over the pixels [1]. Pixels that a clip level cuts off have a mean near that level. If the
 * level is rare noise, or the quantization is as coarse as the noise, the distance is some standard deviations. */
struct ExtremeDepths
{
  double low{ 0.0 };  ///< depth of the lowest level [1]
  double high{ 0.0 }; ///< depth of the highest level [1]
};

/** Returns whether a pile-up is evidence of clipping. It is not if the noise is below half a step of the levels,
 * because then every level piles up. Nor is it if \a depth, see ExtremeDepths, is 2.5 or more. \a typicalVarianceDn2
 * is the median variance of the pixels that vary [DN^2], \a stepDn the spacing of the levels [DN]. */
inline bool
IsPileUpEvidence(double typicalVarianceDn2, double stepDn, double depth)
{
  return typicalVarianceDn2 >= InCommon.hiddenVariance * stepDn * stepDn && depth < InMoments.largestPileUpDepth;
}

} // namespace sensornoise

#endif
