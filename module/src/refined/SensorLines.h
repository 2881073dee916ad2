// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_SensorLines_h
#define sensornoise_refined_SensorLines_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseCorrelation.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

namespace sensornoise
{

/** The lines of a StaticVariance: of the pixels' variance as it is, or as the sensor had it before neighbours and
 * frames shared it. */
struct SensorLines
{
  VarianceLine  all;        ///< through all pixels that fit a static scene
  VarianceLine  fromLight;  ///< by light alone, see FitLightLine(); may be not determined
  VarianceCurve fromFrames; ///< by frames of unequal illumination, see FitFramePhotonTransfer(); may be not determined
  VarianceCurve curve;      ///< how the variance departs from its line
  /** Of gain and intercept: what is not known of what is shared. */
  Eigen::Matrix2d errorOfShared{ Eigen::Matrix2d::Zero() };
  /** See StaticVariance::ofOwnLevels. */
  VarianceCurve ofOwnLevels;
};

/** The lines of the variance as it is. */
SensorNoise_EXPORT SensorLines
LinesOf(const StaticVariance & variance);

/** What a pixel's noise has to be multiplied by to be that of the sensor's, where a filter after the read-out shares it
 * [1]. \see VarianceOfSensor */
SensorNoise_EXPORT double
FilterFactor(const NoiseCorrelation & correlation);

/** The variance of a pixel without light before a filter, which the codes' noise, \a codesDn2, has not passed, without
 * that of its row and column [DN^2]. */
SensorNoise_EXPORT double
VarianceOfSensor(double varianceDn2, const NoiseCorrelation & correlation, double codesDn2);

/** By how much that is not known, as the filter may lie before the read-out or after it: a standard deviation [DN^2].
 */
SensorNoise_EXPORT double
SpreadOfShapes(double varianceDn2, const NoiseCorrelation & correlation, double codesDn2);

/** The lines of the variance that the sensor's pixels had: with what neighbours and frames share, summed over all lags,
 * and without the noise of whole rows and columns. Levels are light above \a blackDn. */
SensorNoise_EXPORT SensorLines
WithSharedNoise(const SensorLines & lines, const NoiseCorrelation & correlation, double blackDn, double codesDn2);

} // namespace sensornoise

#endif
