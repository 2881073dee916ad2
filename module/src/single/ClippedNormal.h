// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_ClippedNormal_h
#define sensornoise_single_ClippedNormal_h

#include "SensorNoiseExport.h"

#include <limits>

namespace sensornoise
{

/** Levels between which a value is cut off [DN]; infinite: it is not. */
struct ClipLevels
{
  double lowDn{ -std::numeric_limits<double>::infinity() };
  double highDn{ std::numeric_limits<double>::infinity() };
};

/** Moments of a normal variable that is set to a clip level where it is beyond. */
struct ClippedMoments
{
  double meanDn{ 0.0 };
  double varianceDn2{ 0.0 };
  double unclipped{ 1.0 }; ///< probability of a value between the clip levels [1]
};

/** Returns the moments of a normal variable of mean \a meanDn and standard deviation \a sdDn > 0, clipped at both ends:
 * the integrals of x and x^2 over the normal density between the levels, and the levels' own shares. */
SensorNoise_EXPORT ClippedMoments
MomentsOfClipped(double meanDn, double sdDn, const ClipLevels & levels);

/** Variance against level before clipping: slope times (level - centre) + variance at the centre. */
struct CentredLine
{
  double centreDn{ 0.0 };
  double slopeDn{ 0.0 }; ///< [DN/e-]
  double atCentreDn2{ 0.0 };

  double
  At(double levelDn) const
  {
    return atCentreDn2 + slopeDn * (levelDn - centreDn);
  }
};

/** Returns the moments of the pixels whose mean after clipping is \a clippedMeanDn, if \a line is their variance before
 * clipping, but at least \a leastVarianceDn2 > 0. */
SensorNoise_EXPORT ClippedMoments
ClippedAtMean(double clippedMeanDn, const CentredLine & line, const ClipLevels & levels, double leastVarianceDn2);

} // namespace sensornoise

#endif
