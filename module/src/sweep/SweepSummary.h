// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_SweepSummary_h
#define sensornoise_sweep_SweepSummary_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "sweep/Setting.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

/** \file The gains of the settings of a sweep: the common level of most of them, their lines with the switch of the
 * conversion gain, and the common gain of exposures. With them, the summary of the sweep. */

namespace sensornoise
{

/** Chosen numbers of the component `sweep`. */
struct SweepConstants
{
  /** Standard error that is added to each ln(gain / setting) [1]: the steps of the amplifier, and nominal ISO speeds,
   * which deviate from third-stops by up to 1.6 % (1250 is 1270). */
  double gainRounding{ 0.01 };
  /** Standard error that is added to each read noise, relative to it [1]: what the model of two amplifier stages leaves
   * out. Chosen empirically. */
  double readNoiseModelError{ 0.02 };
  /** Smallest relative deviation of a gain from the line, and smallest step of gain / setting, that counts [1]: three
   * times the largest rounding of a nominal ISO speed. */
  double leastGainDeviation{ 0.05 };
  /** Smallest relative deviation of a gain from the gains at other exposures that counts [1]. The exposure changes no
   * amplifier; 1 % is the accuracy that is asked of a gain. */
  double leastCommonGainDeviation{ 0.01 };
  /** Smallest drop of the read noise in electrons, relative to it, that is a switch of the conversion gain [1]. A
   * switch changes the conversion gain by a factor of 1.5 or more, and the read noise by much more than a tenth.
   */
  double leastReadNoiseDrop{ 0.1 };
  /** Settings that are needed on each side of a switch. A single setting that deviates is no switch. */
  std::size_t leastSettingsOfSide{ 2 };
  /** Number of settings with a read noise that the model of the read noise needs: two more than its three parameters.
   */
  std::size_t leastReadNoises{ 5 };
};

SENSORNOISE_CONSTANT SweepConstants InSweep;

/** ln(gain / setting) of one setting. */
struct GainRatio
{
  double setting{ 0.0 };
  double logRatio{ 0.0 };
  double standardError{ 0.0 }; ///< with SweepConstants::gainRounding
};

/** Level of the largest group of ratios. */
struct GainLevel
{
  double logRatio{ 0.0 };
  double standardError{ 0.0 };
  double loss{ 0.0 }; ///< sum of squared deviations over their errors, each at most Significance.severalTests squared
  double chi2{ 0.0 }; ///< chi-square of only the settings on the level [1]
  std::size_t settings{ 0 }; ///< number of settings on the level
};

/** Returns the ratios of all settings with a gain. */
std::vector<GainRatio>
GainRatiosOf(const std::vector<SettingNoise> & settings);

/** Returns whether a ratio is on the level: within Significance.oneTest errors or SweepConstants::leastGainDeviation.
 */
bool
IsOnLevel(const GainRatio & ratio, const GainLevel & level);

/** Finds the level of the least loss, of the ratios from \a first to before \a last. There must be one or more. */
GainLevel
FindGainLevel(const std::vector<GainRatio> & ratios, std::size_t first, std::size_t last);

/** Setting at which a camera switches its conversion gain, with the steps of gain and read noise. At least one of the
 * two steps is known. */
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
  /** One line, with the range of its settings. */
  struct Part
  {
    NumberWithError scale;          ///< gain over setting [DN/e-]
    double          lowest{ 0.0 };  ///< lowest setting of the part
    double          highest{ 0.0 }; ///< highest setting of the part
    std::size_t     settings{ 0 };  ///< number of settings on the line
    /** Reduced chi-square of the settings on the line, with SweepConstants::gainRounding [1]. */
    double reducedChi2{ 0.0 };
  };
  std::vector<Part> parts; ///< one line, or two if the switch changes gain / setting; empty: no line
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

/** Common gain of settings that differ only in the exposure time, and whether they have a common gain. */
struct CommonGain
{
  std::string     channel{ "mono" };
  NumberWithError gain;               ///< weighted mean of the gains [DN/e-]
  std::size_t     settings{ 0 };      ///< settings with a gain and its error
  double          reducedChi2{ 0.0 }; ///< scatter of the gains over their errors, squared [1]
  bool            isSame{ true };     ///< whether no setting differs from the others
  double          setting{ 0.0 }; ///< setting that deviates most in standard errors, if possible a setting that differs
  NumberWithError deviation;      ///< gain of this setting over the weighted mean of the other gains, less 1 [1]
};

/** Tests whether the gains of settings are equal, and pools them as their mean, weighted by 1 / error squared.
 *
 * Each gain is compared with the weighted mean of all others. A setting differs if its deviation exceeds both
 * SweepConstants::leastCommonGainDeviation and Significance.severalTests standard errors. If the
 * gains scatter by more than their errors, the error of the mean is multiplied by the root of the reduced chi-square.
 * Returns none if fewer than two settings have a gain with an error above 0. Throws std::invalid_argument as
 * RequireSettings(). */
SensorNoise_EXPORT std::optional<CommonGain>
FindCommonGain(const std::vector<SettingNoise> & settings);

/** Numbers of one channel of a camera at one setting; none where a number is not identified. */
struct SweepRow
{
  double                         setting{ 0.0 };
  std::string                    channel; ///< "mono", "R", "G1", "G2" or "B"
  std::optional<NumberWithError> gain;    ///< g [DN/e-]
  std::optional<NumberWithError> offsetDn;
  std::optional<NumberWithError> readNoiseDn;
  std::optional<NumberWithError> readNoiseElectrons;
  /** Full well: the level at which pixels saturate, else the white level, minus the offset, over the gain [e-]. */
  std::optional<NumberWithError> fullWellElectrons;
  /** Dynamic range: 20 log10 of the full well over the read noise [dB]. */
  std::optional<NumberWithError> dynamicRangeDb;
};

/** A setting whose burst could not be measured. */
struct UnmeasuredSetting
{
  std::string           name;    ///< name of the burst in the table
  std::optional<double> setting; ///< none: not known
  std::string           reason;  ///< a sentence
};

/** A camera over its range of settings. */
struct SweepSummary
{
  std::string                    camera; ///< maker and model; "": not known
  SettingKind                    kind{ SettingKind::Iso };
  std::vector<SweepRow>          rows; ///< by setting, then by channel
  std::vector<UnmeasuredSetting> unmeasured;
  std::vector<SettingNoise>      settings; ///< means over the channels, see MeanOverChannels()
  std::optional<GainSwitch>      conversionSwitch;
  GainLine                       line;        ///< without parts if the settings are exposures
  std::vector<CommonGain>        commonGains; ///< common gain of each channel; empty unless the settings are exposures
  std::optional<NoiseExport>     android;     ///< ExportAndroid(); none: androidReason says why
  std::string                    androidReason;   ///< "" for gains, and for fewer than two ISO speeds
  std::optional<NoiseExport>     darktable;       ///< ExportDarktable(); none: darktableReason says why
  std::string                    darktableReason; ///< "" for gains, and for fewer than two ISO speeds
};

/** Returns gain and read noise of each setting. For a mosaic they are the geometric means over the same channels at
 * every setting: over the channel that has the number at the most settings, and the other channels that have it at
 * these settings. Channels have different gains where the camera scales them, by the same factors at every setting. */
SensorNoise_EXPORT std::vector<SettingNoise>
MeanOverChannels(const MeasuredRange & range);

/** Returns the numbers, the line and the switch of the measured settings, and of two ISO speeds or more the fit of
 * Android's noise model and darktable's presets. Exposures have no line and no switch: their gains are tested for
 * equality, and pooled. */
SensorNoise_EXPORT SweepSummary
SummariseSweep(const MeasuredRange & range, const std::vector<UnmeasuredSetting> & unmeasured = {});

/** Returns the settings that leave the line of the gains, with their gain over the line, less 1 [1]. */
SensorNoise_EXPORT std::map<double, double>
SettingsOffLine(const SweepSummary & summary);

/** Returns the table of all settings as plain text in UTF-8, and the sentences of FindingsOf(). */
SensorNoise_EXPORT std::string
MakeText(const SweepSummary & summary);

/** Returns what was found as JSON, the members of a passport beside its reports: `camera`, `gain_line`,
 * `conversion_gain_switch`, `common_gain`, `android`, `darktable` and `findings`; and `channels`, a list for each
 * measured setting with the numbers of its channels. The `model` of `android` and `darktable` is a text, the JSON of
 * its file. */
SensorNoise_EXPORT std::string
ToJson(const SweepSummary & summary);

/** Returns sentences about the line of the gains, the settings that leave it, the switch of the conversion gain, the
 * common gain of exposures, Android's noise model, and darktable's presets. */
SensorNoise_EXPORT std::vector<std::string>
FindingsOf(const SweepSummary & summary);

/** Returns the sweep as one HTML page, without network access and scripts: the findings, the table, and each
 * of its numbers against the setting. The axes are logarithmic, but for the dynamic range in dB and the offset. */
SensorNoise_EXPORT std::string
ToHtml(const SweepSummary & summary);

/** Columns of the table of a sweep. */
inline constexpr std::size_t SweepColumns = 8;

using SweepCellRow = std::array<std::string, SweepColumns>;
using SweepCells = std::vector<SweepCellRow>;

/** Returns the table of the measured settings as text, with the names of its columns in the first row. */
SweepCells
SweepCellsOf(const SweepSummary & summary);

/** Returns the camera and how many settings were measured. */
std::string
SweepTitle(const SweepSummary & summary);

} // namespace sensornoise

#endif
