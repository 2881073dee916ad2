// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_GainLine_h
#define sensornoise_sweep_GainLine_h

#include "SensorNoiseExport.h"
#include "sweep/SettingNoise.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Place at which a camera switches its conversion gain, and what changes there. One of the two steps is there. */
struct GainSwitch
{
  double below{ 0.0 }; ///< highest setting before the switch
  double above{ 0.0 }; ///< lowest setting behind the switch
  /** Gain over setting behind the switch, relative to before [1]; none: not significant. Cameras whose ISO speeds are
   * true have none. */
  std::optional<NumberWithError> gainStep;
  /** Read noise in electrons behind the switch, relative to the read noise without it, at the geometric mean of below
   * and above [1]; none: not significant. */
  std::optional<NumberWithError> readNoiseStep;
};

/** Finds the switch of the conversion gain in a sweep, for instance of a sensor with dual conversion gain.
 *
 * Two signs are tested at each place with two settings or more on both sides, which a single deviating setting cannot
 * show. The read noise in electrons follows sigma^2 = A + B / setting^2, noise before and behind the amplifier; the
 * switch lowers A and leaves B. The logarithm of gain / setting is constant, and a step divides it in two levels, each
 * shared by two settings or more. A sign counts if it exceeds its least size (SweepConstants), and its chi-square
 * Significance.severalTests squared. The chi-square of the read noise is divided by the reduced chi-square of the model
 * with the switch, if that is above 1. Where both signs are found at places that exclude each other, the more
 * significant one counts. Returns none if no sign counts. Throws std::invalid_argument as RequireSettings(). */
SensorNoise_EXPORT std::optional<GainSwitch>
FindGainSwitch(const std::vector<SettingNoise> & settings);

/** The lines gain = scale x setting of a sweep. */
struct GainLine
{
  /** One line: settings from the lowest to the highest one. */
  struct Part
  {
    NumberWithError scale;              ///< gain over setting [DN/e-]
    double          lowest{ 0.0 };      ///< lowest setting of the part
    double          highest{ 0.0 };     ///< highest setting of the part
    std::size_t     settings{ 0 };      ///< settings on the line
    double          reducedChi2{ 0.0 }; ///< of the settings on the line, with SweepConstants::gainRounding [1]
  };
  std::vector<Part> parts; ///< one; two if the switch changes gain / setting; none: no line
  /** Deviation of the gain of each setting from its line, relative to it [1]; none: no gain, or no line. */
  std::vector<std::optional<double>> deviation;
  std::vector<bool> isBeside; ///< whether the setting leaves the line, for instance an extended ISO speed
};

/** Fits gain = scale x setting by weighted least squares of the logarithms. The line goes through the largest group of
 * settings that agree: a setting leaves it if its gain deviates by more than Significance.oneTest standard errors and
 * SweepConstants::leastGainDeviation. There is no line if fewer than two settings, or not more than half of them, are
 * on it. Throws std::invalid_argument as RequireSettings(). */
SensorNoise_EXPORT GainLine
FitGainLine(const std::vector<SettingNoise> & settings, const std::optional<GainSwitch> & conversionSwitch);

} // namespace sensornoise

#endif
