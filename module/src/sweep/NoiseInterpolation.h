// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_NoiseInterpolation_h
#define sensornoise_sweep_NoiseInterpolation_h

#include "SensorNoiseExport.h"
#include "sensornoise/NoiseExport.h"
#include "sweep/Setting.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The measured settings of a camera. */
struct MeasuredRange
{
  std::vector<CameraNoise>                 noise; ///< noise of one camera at its settings, each with the same channels
  std::vector<double>                      settings;      ///< setting of each of noise, in ascending order
  std::optional<std::pair<double, double>> switchBetween; ///< settings between which the conversion gain is switched
  SettingKind                              kind{ SettingKind::Iso };
};

/** The noise at a setting that was not measured. */
struct InterpolatedNoise
{
  CameraNoise noise;
  double      below{ 0.0 }; ///< the measured settings around it; both equal the setting if it was measured
  double      above{ 0.0 };
};

/** Returns the noise of the camera at a \a setting: the measured one, or the interpolation between the neighbours on
 * the same side of the switch.
 *
 * Gain, slope of the variance, read noise and the variance at the dark offset are interpolated in logarithms, the
 * offset and the levels linearly in ln(setting), each with InterpolateNumber(). The total intercept is the variance at
 * the offset minus slope times offset. Where the offset is not identified, the black level takes its place. Levels at
 * which pixels saturate, and the measured range of levels, are the narrower ones. A quantity that is not identified at
 * one of the neighbours is missing. Throws ExportError if the setting is outside of the measured ones, the switch is
 * between its neighbours, or the channels of the settings differ. */
SensorNoise_EXPORT InterpolatedNoise
InterpolateNoise(const MeasuredRange & range, double setting);

/** Returns a sentence about an interpolated noise: its neighbours, and the gain with its error. "" if it was measured.
 */
SensorNoise_EXPORT std::string
SentenceOf(const InterpolatedNoise & noise);

/** Returns the settings that a format of ExportNoise() is made of: the noise at a \a setting, measured or interpolated;
 * without one all measured settings. Adds SentenceOf() to \a note. Throws ExportError as InterpolateNoise(), and if the
 * format takes one setting, none is given and several were measured. \a passport is the name of the range in this
 * error. */
SensorNoise_EXPORT std::vector<CameraNoise>
ChooseSettings(const MeasuredRange &         range,
               const std::string &           format,
               const std::optional<double> & setting,
               const std::string &           passport,
               std::string &                 note);

} // namespace sensornoise

#endif
