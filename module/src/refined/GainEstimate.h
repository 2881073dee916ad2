// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainEstimate_h
#define sensornoise_refined_GainEstimate_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Settings.h"
#include "pixels/VarianceLine.h"
#include "pixels/VarianceCurve.h"
#include "refined/RefinedResults.h"
#include "refined/SensorLines.h"

#include <optional>

namespace sensornoise
{

/** Gain and intercept of the sensor, with their complete errors. */
struct GainEstimate
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

  /** Whether the dark frames contradict the line of the bright frames or contain signal, and are not used for the gain.
   */
  bool isDarkRejected{ false };
  /** Whether the line of the bright frames alone is precise enough for dark frames to test the linearity of the
   * response; false if all levels are equal. */
  bool isLinearityTested{ false };

  /** Returns whether the gains of parts of the levels differ significantly. */
  bool
  IsNonlinear() const
  {
    return below > 0.0 || above > 0.0;
  }
  /** Returns the relative error of the gain by a non-linear response [1]; 0 if the response is linear. */
  double
  RelativeModelError() const;
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

} // namespace sensornoise

#endif
