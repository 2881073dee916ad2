// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainEstimate_h
#define sensornoise_refined_GainEstimate_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Settings.h"
#include "pixels/VarianceLine.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceStep.h"
#include "refined/RefinedResults.h"
#include "refined/SensorLines.h"

#include <optional>

namespace sensornoise
{

/** Gain and intercept of the sensor, with all that is known of their errors. */
struct GainEstimate
{
  /** The line that stands for the sensor. */
  VarianceLine line;
  /** How the variance departs from it along the levels. */
  VarianceCurve curve;
  /** Of gain and intercept: the fit's, widened by all that contradicts it. */
  Eigen::Matrix2d covariance{ Eigen::Matrix2d::Zero() };
  /** How far below and above the gain parts of the levels put it: the error of taking the response for straight, beyond
   * what chance makes of it [DN/e-]. */
  double below{ 0.0 };
  double above{ 0.0 };
  /** D, the size of the variance's departure from a line, see VarianceCurve [1]. */
  double nonlinearity{ 0.0 };
  /** Whether the line is by what frames of unequal illumination have of variance and level, see
   * FitFramePhotonTransfer(), and not by what pixels have. */
  bool isFromFrames{ false };
  /** Whether the darkest levels have so much less light than the brightest that a bend could be told from noise. */
  bool isWide{ true };
  /** Reduced chi-square of the variance about its line, along the intensity. */
  double reducedChi2{ 1.0 };
  /** Where the variance steps, as between two amplifiers: the line is that of the levels below, the gain that of both
   * sides. Null: it does not. */
  std::optional<VarianceStep> step;
  /** About the gain, whatever the slope: the variance over the light, both at the pivot [DN/e-]. */
  double scale{ 0.0 };

  /** The line's value at the offset of dark frames, before these were used; null: there are none, or a
   * bend of the response may part them from the line. */
  std::optional<DarkVariance> atOffset;

  /** Whether the dark frames contradict the line of the bright frames, or hold signal, and are not in the gain. */
  bool isDarkRejected{ false };
  /** Whether the line of the bright frames alone is precise enough for dark frames to test the linearity of the
   * response: not for levels of one height. */
  bool isLinearityTested{ false };

  /** Whether parts of the levels differ visibly. */
  bool
  IsBent() const
  {
    return below > 0.0 || above > 0.0;
  }
  /** Of a gain, where the response bends [1]. */
  double
  RelativeModelError() const;
  /** With the model's error. */
  double
  StandardError() const;
};

/** Puts the results together: the line of all pixels, or of what is light alone where the pixels' own patterns matter
 * more than precision; the point (offset, variance) of dark frames; and, where the response bends, the gains of the
 * parts of the levels. \a lines are those of \a found's variance, or what the sensor had before it was shared. */
SensorNoise_EXPORT GainEstimate
EstimateGain(const RefinedResults & found, const SensorLines & lines);

/** Of the variance as it is. */
inline GainEstimate
EstimateGain(const RefinedResults & found)
{
  return EstimateGain(found, LinesOf(found.variance));
}

} // namespace sensornoise

#endif
