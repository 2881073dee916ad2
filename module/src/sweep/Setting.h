// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_Setting_h
#define sensornoise_sweep_Setting_h

#include "SensorNoiseExport.h"
#include "sensornoise/NoiseExport.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * The settings of a sweep: their kinds and names, the noise at one of them, and numbers between them. */

namespace sensornoise
{

/** Quantity in which the settings of a sweep differ. */
enum class SettingKind : std::uint8_t
{
  Iso,     ///< ISO speeds
  Gain,    ///< gains of the amplifier as factors
  Exposure ///< exposure times [s] at one gain
};

/** Returns "iso", "gain" or "exposure". */
SensorNoise_EXPORT const char *
NameOf(SettingKind kind);

/** Returns the kind with this name. Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT SettingKind
SettingKindOf(const std::string & name);

/** Returns "ISO 800", "gain 2" or "exposure 0.01 s". */
SensorNoise_EXPORT std::string
SettingText(SettingKind kind, double setting);

/** Setting from a name or a table. */
struct NamedSetting
{
  SettingKind kind{ SettingKind::Iso };
  double      value{ 0.0 }; ///< ISO speed, gain as a factor, or exposure time [s]
};

/** Returns 10^(decibels / 20), the factor of a gain in dB. */
SensorNoise_EXPORT double
GainOfDecibels(double decibels);

/** Returns the setting in the name of a folder or a stack: "iso800", "ISO 800", "800" (an ISO speed), "gain2.5",
 * "gain6dB", which is a factor of 2, "exposure10ms", "exp0.5s", or "10ms". Letters may stand before and behind
 * "iso800", "gain2.5" and "exposure10ms". Empty if there is none, or it is not above 0. */
SensorNoise_EXPORT std::optional<NamedSetting>
SettingInName(const std::string & name);

/** A number with its standard error, which is 0 or more, in the same unit. */
struct NumberWithError
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Gain and read noise of a camera at one setting of its amplification. */
struct SettingNoise
{
  double                         setting{ 0.0 };     ///< ISO speed, gain as a factor [1], or exposure time [s]; above 0
  std::optional<NumberWithError> gain;               ///< g [DN/e-], above 0; none: not identified
  std::optional<NumberWithError> readNoiseElectrons; ///< sigma / g [e-], above 0; none: not identified
};

/** Throws std::invalid_argument unless the settings are above 0, finite and in ascending order, all numbers are above
 * 0, and all errors 0 or more. */
void
RequireSettings(const std::vector<SettingNoise> & settings);

/** A number at one setting of the camera. */
struct SettingNumber
{
  double          setting{ 0.0 }; ///< above 0
  NumberWithError number;
};

/** Returns the number at a \a setting between two neighbouring settings of \a points, which are in ascending order.
 *
 * The line is straight in ln(setting) and, with \a isLogarithmic, in ln(number): then all numbers are above 0. Its
 * standard error has two parts, added in squares: the errors of both neighbours by their weights, and the largest error
 * of a straight line through a curve, |(x - x0) (x - x1) f''/2|. Here f''/2 is the larger of the second divided
 * differences with the point before and the point behind, and 0 if there is neither. Throws std::invalid_argument
 * unless there are two points and the setting is between the first and the last one. */
SensorNoise_EXPORT NumberWithError
InterpolateNumber(const std::vector<SettingNumber> & points, double setting, bool isLogarithmic);

/** The measured settings of a camera. */
struct MeasuredRange
{
  std::vector<CameraNoise>                 noise; ///< noise of one camera at its settings, each with the same channels
  std::vector<double>                      settings;      ///< setting of each of noise, in ascending order
  std::optional<std::pair<double, double>> switchBetween; ///< settings between which the conversion gain is switched
  SettingKind                              kind{ SettingKind::Iso };
  std::map<double, std::string>            unmeasured; ///< settings whose burst could not be measured, with the reasons
  std::map<double, double> offLine; ///< settings that leave the line of the gains: gain over the line, less 1 [1]
};

/** Adds a measured setting to the range, whose kind is known. An ISO speed replaces the ISO speed of the report. A gain
 * is the analogue gain of libcamera, unless the noise has one other than 1. */
SensorNoise_EXPORT void
AddSetting(MeasuredRange & range, const CameraNoise & noise, double setting);

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
 * between its neighbours, a neighbour leaves the line of the gains, or the channels of the settings differ. */
SensorNoise_EXPORT InterpolatedNoise
InterpolateNoise(const MeasuredRange & range, double setting);

/** Returns a sentence about an interpolated noise: its neighbours, gain and read noise with their errors. "" if it was
 * measured.
 */
SensorNoise_EXPORT std::string
SentenceOf(const InterpolatedNoise & noise);

/** Returns the settings for a format of ExportNoise(): the noise at a \a setting, measured or interpolated; without \a
 * setting all measured settings. Adds SentenceOf() to \a note. Throws ExportError as InterpolateNoise(), and if the
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
