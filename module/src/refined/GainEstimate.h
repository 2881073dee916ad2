// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainEstimate_h
#define sensornoise_refined_GainEstimate_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseCorrelation.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Settings.h"

#include <optional>

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
  /** Covariance of gain and intercept by the uncertainty of the noise correlation, and by pixels that are computed from
   * their neighbours [DN/e-, DN^2]. */
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
 * \a varianceDn2 is the measured variance [DN^2]. \a quantisationDn2 is the variance of the quantization noise, which
 * was added after the filter [DN^2]. */
SensorNoise_EXPORT double
VarianceOfSensor(double varianceDn2, const NoiseCorrelation & correlation, double quantisationDn2);

/** Returns the standard deviation of VarianceOfSensor() over the shapes of the correlation: the filter may lie before
 * the read-out or after it [DN^2]. */
SensorNoise_EXPORT double
StandardDeviationOfShapes(double varianceDn2, const NoiseCorrelation & correlation, double quantisationDn2);

/** Returns the lines of the sensor's variance: with the covariances summed over all lags, and without the noise of
 * whole rows and columns. The signal is measured from \a blackDn [DN]; \a quantisationDn2 is the variance of the
 * quantization noise [DN^2]. */
SensorNoise_EXPORT SensorLines
AddCovariances(const SensorLines & lines, const NoiseCorrelation & correlation, double blackDn, double quantisationDn2);

/** Gain and intercept of the sensor, with their complete errors. */
struct SensorNoise_EXPORT GainEstimate
{
  /** Line of the variance whose slope is the gain. */
  VarianceLine line;
  /** Deviations of the variance from its line, by level. */
  VarianceCurve curve;
  /** Covariance of gain and intercept [DN/e-, DN^2]: of the fit, widened by scatter about the line and by systematic
   * errors. */
  Eigen::Matrix2d covariance{ Eigen::Matrix2d::Zero() };
  /** Distance of the gains of parts of the levels below and above the gain, without their statistical scatter: the
   * error of assuming a linear response [DN/e-]. */
  double below{ 0.0 };
  double above{ 0.0 };
  /** D, the largest deviation of the variance from a line, see VarianceCurve [1]. */
  double nonlinearity{ 0.0 };
  /** Whether the line is from frames of unequal illumination, see FitFramePhotonTransfer(), and not from pixels. */
  bool isFromFrames{ false };
  /** Whether the darkest levels have so little signal, compared to the brightest, that a non-linear response is
   * distinguishable from noise. */
  bool isWide{ true };
  /** Reduced chi-square of the variance about its line, along the intensity [1]. */
  double reducedChi2{ 1.0 };
  /** Step of the variance, as between two amplifiers. The line is then the line of the levels below the step, and the
   * gain is the gain of both sides. Null: no step. */
  std::optional<VarianceStep> step;
  /** Approximate gain that does not depend on the slope: variance over signal, both at the pivot [DN/e-]. */
  double scale{ 0.0 };

  /** Value of the line at the offset of the dark frames, before these are used. Null: there are no dark frames, or a
   * non-linear response may explain their difference from the line. */
  std::optional<DarkVariance> atOffset;

  /** Difference of the variance between the dark frames and the line at their offset, without its scatter by chance
   * [DN^2]; 0 where a non-linear response may explain it. */
  double darkDifferenceDn2{ 0.0 };

  /** Whether the known offset lies above the level that does not flicker: it is not the offset of the frames. */
  bool isOffsetAboveFlicker{ false };
  /** Whether the dark frames contradict the line of the bright frames or their flicker, or contain signal. Then they
   * are not used for the gain. */
  bool isDarkRejected{ false };
  /** Whether the line of the bright frames alone is precise enough for dark frames to test the linearity of the
   * response. If the levels are alike (see isWide), its slope must be the more precise. */
  bool isLinearityTested{ false };

  /** Returns whether the gains of parts of the levels differ significantly. */
  bool
  IsNonlinear() const
  {
    return below > 0.0 || above > 0.0;
  }
  /** Returns whether the response is visibly non-linear: the variance also deviates from its line by a size that
   * counts. */
  bool
  IsCurved() const;
  /** Returns the relative error of the gain by a non-linear response [1]; 0 if the response is linear. */
  double
  RelativeModelError() const;
  /** Returns a size that the gain certainly has, to which its errors are compared [DN/e-]: scale, or the lower bound of
   * its own interval, 2 standard errors below it. Without the dark offset, scale may be much too small. */
  double
  Size() const;
  /** Returns the standard error of the gain, including the error of the model [DN/e-]. */
  double
  StandardError() const;
};

/** Estimates gain and intercept. The line is from all pixels, or from the instrumental-variable fit where the error by
 * fixed-pattern noise is larger than the loss of precision. The point (offset, variance) of dark frames is added. If
 * the response is non-linear, the gains of the parts of the levels are used. \a lines are the lines of the variance in
 * \a found, or of the variance before filters. */
SensorNoise_EXPORT GainEstimate
EstimateGain(const RefinedResults & found, const SensorLines & lines);

/** Estimates gain and intercept from the variance without correction for noise correlation. */
inline GainEstimate
EstimateGain(const RefinedResults & found)
{
  return EstimateGain(found, LinesOf(found.variance));
}

/** Returns a covariance of gain and intercept that adds \a errorOfSlope to the gain, and nothing to the variance at the
 * pivot. */
inline Eigen::Matrix2d
SlopeCovariance(double errorOfSlope, double pivotDn)
{
  Eigen::Matrix2d added;
  added << 1.0, -pivotDn, -pivotDn, pivotDn * pivotDn;
  return errorOfSlope * errorOfSlope * added;
}

/** Moves the line towards the point (mu, sigma^2) of the dark frames, their offset and variance. If all bright levels
 * are equal, this is the photon transfer of EMVA 1288, gain = (V - sigma^2) / (mean - mu).
 *
 * The dark point is one more point of the variance line. It contradicts the line of the bright frames if both differ
 * by more than Significance.severalTests of their errors, and by more than InCommon.leastDarkDifference of the
 * variance. Then it is not used, unless the response is visibly non-linear.
 *
 * A non-linear response may explain the difference if it is visible, or if the bright frames have no levels near the
 * dark offset. Then GainEstimate::atOffset is not set. If the response is visibly non-linear, or the difference is
 * smaller but significant, the gain is the mean of the gains of the levels, (V - sigma^2) / (mean - mu). Its error is
 * their scatter.
 *
 * A difference that is significant, and not by a non-linear response, may have two causes: chance, or dark frames of
 * another black level or read noise. The errors of gain, offset and read noise then hold both, by the difference beyond
 * chance. */
SensorNoise_EXPORT void
CombineWithDarkPoint(GainEstimate & estimate, const RefinedResults & found);

} // namespace sensornoise

#endif
