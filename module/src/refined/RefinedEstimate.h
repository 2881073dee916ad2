// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedEstimate_h
#define sensornoise_refined_RefinedEstimate_h

#include "SensorNoiseExport.h"
#include "refined/FlickerSeries.h"
#include "refined/MotionEstimate.h"
#include "refined/OffsetEstimate.h"
#include "refined/RefinedResults.h"
#include "refined/SensorQuantities.h"
#include "sensornoise/Settings.h"

#include <optional>

namespace sensornoise
{

/** Estimates of the refined method from the results of its passes: every number with its error and verdict, and the
 * numbers of messages, but no message. MakeRefinedReport() makes the report of it. */
struct RefinedEstimate
{
  /** Line of the variance of the frames as they are: what a denoiser needs. */
  TestedGain ofFrames;
  /** Line of the variance before filters and without the noise of rows and columns: gain and intercept of the sensor.
   */
  TestedGain      ofSensor;
  DarkQuantities  dark;
  SeriesOfFlicker flicker;
  SeriesOfMotion  motion;

  /** Dark frames or offset that are given, with the dark variance of the sensor before filters. */
  std::optional<KnownOffset> known;
  OffsetEstimate             flickerOffset; ///< offset as the flicker determines it
  OffsetLimits               limits;

  /** Whether the gain has only bounds and is not identified, as frames have fewer samples than pixels. */
  bool isWithheld{ false };
  /** Whether the known offset and the offset by the flicker differ by more than their errors: some illumination is
   * steady. */
  bool isIlluminationSteady{ false };
  /** Whether the known offset lies outside of its limits. */
  bool isOffsetOutOfLimits{ false };
  /** Addition of the illumination of rows or columns to the slope of the variance, where it is too large [1]; 0: it is
   * not. */
  double effectOfLines{ 0.0 };
  /** Standard deviation that the vibration may have, where it is strong [pixel]; null: it is not. */
  std::optional<double> strongVibrationPixels;
  /** Ratio of the signals of the darkest and the brightest areas [1], if it is so large that a non-linear response
   * would not be noticed; null: it is not. */
  std::optional<double> uncheckedFraction;

  /** Returns whether the verdict on the sensor follows from its variance line alone.
   */
  bool
  IsSensorLineTested() const
  {
    return ofSensor.verdict != GainVerdict::LineIllumination && ofSensor.verdict != GainVerdict::NoiseNotLinear;
  }
};

/** Decides on every quantity by the results of the passes. */
SensorNoise_EXPORT RefinedEstimate
EstimateRefined(const RefinedResults & found);

} // namespace sensornoise

#endif
