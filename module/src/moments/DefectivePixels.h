// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DefectivePixels_h
#define sensornoise_moments_DefectivePixels_h

#include "base/ChiSquare.h"
#include "moments/Constants.h"

namespace sensornoise
{

/** Returns the ratio of the median of the variances of pixels with the same noise to their expectation [1].
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
MedianToMeanOfVariance(double dof)
{
  return ChiSquareQuantile(0.5, dof) / dof;
}

/** Returns the variance above which a pixel is defective [DN^2].
 *
 * The limit is the variance of InMoments.defectiveNoiseFactor times the typical noise, times 1 + 2/freedom. Of the
 * pixels whose noise is near the limit, some stay below it by chance and some exceed it; the excluded ones have the
 * larger variances. With this factor the gained and the lost variance are equal, exactly so where the density of the
 * true variances falls as their third power. For other tails they agree to some per cent of the variance near the
 * limit.
 * \param medianDn2 median of the variances of the pixels [DN^2]
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
DefectiveVarianceDn2(double medianDn2, double dof)
{
  const double typicalDn2 = medianDn2 / MedianToMeanOfVariance(dof);
  return InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * typicalDn2 * (1.0 + 2.0 / dof);
}

} // namespace sensornoise

#endif
