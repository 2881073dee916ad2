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

/** Lines of a StaticVariance: of the pixels' variance without correction, or of the variance before noise was
 * correlated. */
struct SensorLines
{
  VarianceLine  all;              ///< through all pixels that fit a static scene
  VarianceLine  instrumentalLine; ///< instrumental-variable fit, see FitInstrumental(); may be not determined
  VarianceCurve fromFrames;       ///< see FitFramePhotonTransfer(); may be not determined
  VarianceCurve curve;            ///< deviations of the variance from its line
  /** Covariance of gain and intercept by the uncertainty of the noise correlation [DN/e-, DN^2]. */
  Eigen::Matrix2d covarianceOfCorrelation{ Eigen::Matrix2d::Zero() };
  /** Curve by the pixels' own levels, see StaticVariance::ofOwnLevels. */
  VarianceCurve ofOwnLevels;
};

/** Returns the lines of the variance without correction. */
SensorNoise_EXPORT SensorLines
LinesOf(const StaticVariance & variance);

/** Returns the factor from a pixel's noise variance to the variance of the sensor, if a filter after the read-out
 * causes the correlation [1]. \see VarianceOfSensor */
SensorNoise_EXPORT double
FilterFactor(const NoiseCorrelation & correlation);

/** Returns the variance of a pixel at zero signal before a filter, without the noise of rows and columns [DN^2].
 * \a varianceDn2 is the measured variance [DN^2]. \a codesDn2 is the variance of the quantization noise, which was
 * added after the filter [DN^2]. */
SensorNoise_EXPORT double
VarianceOfSensor(double varianceDn2, const NoiseCorrelation & correlation, double codesDn2);

/** Returns the standard deviation of VarianceOfSensor() over the shapes of the correlation: the filter may lie before
 * the read-out or after it [DN^2]. */
SensorNoise_EXPORT double
StandardDeviationOfShapes(double varianceDn2, const NoiseCorrelation & correlation, double codesDn2);

/** Returns the lines of the sensor's variance: with the covariances summed over all lags, and without the noise of
 * whole rows and columns. The signal is measured from \a blackDn [DN]; \a codesDn2 is the variance of the quantization
 * noise [DN^2]. */
SensorNoise_EXPORT SensorLines
AddCovariances(const SensorLines & lines, const NoiseCorrelation & correlation, double blackDn, double codesDn2);

} // namespace sensornoise

#endif
