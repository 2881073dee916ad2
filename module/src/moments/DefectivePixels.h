// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DefectivePixels_h
#define sensornoise_moments_DefectivePixels_h

#include "base/ChiSquare.h"
#include "moments/Constants.h"

namespace sensornoise
{

/** What the median of the variances of pixels with the same noise is of their expectation [1].
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
MedianShareOfVariance(double freedom)
{
  return ChiSquareQuantile(0.5, freedom) / freedom;
}

/** The variance above which a pixel is defective [DN^2].
 *
 * That of InMoments.defectiveNoiseFactor times the typical noise, times 1 + 2/freedom. Of pixels whose noise is near
 * the limit some stay below it by chance and some come to lie above; those that are lost are the ones of large
 * variance. With this factor as much variance is gained as is lost, exactly so where the density of the true variances
 * falls as their third power, and to some per cent of what lies near the limit for other tails.
 * \param medianDn2 median of the pixels' variances [DN^2]
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
DefectiveVarianceDn2(double medianDn2, double freedom)
{
  const double typicalDn2 = medianDn2 / MedianShareOfVariance(freedom);
  return InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * typicalDn2 * (1.0 + 2.0 / freedom);
}

} // namespace sensornoise

#endif
