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
 * What a pile-up is: the mark that a level leaves which the sensor cannot pass. Noise alone puts few pixels' extremes
 * on the outermost level, fewer than on the levels inside of it. A clip level gathers the extremes of all pixels that
 * would have passed it. */

/** Whether \a atEnd pixels whose extreme is the outermost level are a pile-up, if each of the levels inside is the
 * extreme of at most \a mostInside pixels: at least 8, and more than 3 times as many. */
inline bool
IsPileUp(std::size_t atEnd, std::size_t mostInside)
{
  return atEnd >= std::max(InMoments.fewestPixelsOfPileUp, InMoments.pileUpRatio * mostInside + 1);
}

/** How far the outermost levels lie from the mean of the pixels that attain them, in these pixels' temporal standard
 * deviations, as a median. What a clip level cuts off is near the mean or beyond it; where it is just rare noise, or
 * codes as coarse as the noise, that is some standard deviations away. */
struct ExtremeDepths
{
  double low{ 0.0 };
  double high{ 0.0 };
};

/** Whether a pile-up says anything: where the noise, of the median variance \a typicalVarianceDn2 of the pixels that
 * vary, is below half a step of the levels, every level piles up. So it is where \a depth, see ExtremeDepths, is 2.5 or
 * more. */
inline bool
CanTellPileUp(double typicalVarianceDn2, double stepDn, double depth)
{
  return typicalVarianceDn2 >= InCommon.hiddenVariance * stepDn * stepDn && depth < InMoments.largestPileUpDepth;
}

} // namespace sensornoise

#endif
