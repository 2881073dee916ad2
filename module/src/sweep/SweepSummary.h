// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_SweepSummary_h
#define sensornoise_sweep_SweepSummary_h

#include "SensorNoiseExport.h"
#include "sweep/GainLine.h"
#include "sweep/NoiseInterpolation.h"
#include "sweep/Setting.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

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
  std::string                    androidReason; ///< "" for gains, and for fewer than two ISO speeds
};

/** Returns gain and read noise of each setting. Of a mosaic they are the geometric means over the same channels at
 * every setting: over the channel that has the number at the most settings, and the others that have it there. Channels
 * have different gains where the camera scales them, by the same factors at every setting. */
SensorNoise_EXPORT std::vector<SettingNoise>
MeanOverChannels(const MeasuredRange & range);

/** Returns the numbers, the line and the switch of the measured settings, and of two ISO speeds or more the fit of
 * Android's noise model. Exposures have no line and no switch: their gains are tested for equality, and pooled. */
SensorNoise_EXPORT SweepSummary
SummariseSweep(const MeasuredRange & range, const std::vector<UnmeasuredSetting> & unmeasured = {});

/** Returns the table of all settings as plain text in UTF-8, and the sentences of FindingsOf(). */
SensorNoise_EXPORT std::string
MakeText(const SweepSummary & summary);

/** Returns what was found as JSON, the members of a passport beside its reports: `camera`, `gain_line`,
 * `conversion_gain_switch`, `common_gain`, `android` and `findings`; and `channels`, a list for each measured setting
 * with the numbers of its channels. The `model` of `android` is a text, the JSON of its file. */
SensorNoise_EXPORT std::string
ToJson(const SweepSummary & summary);

/** Returns sentences about the line of the gains, the settings that leave it, the switch of the conversion gain, the
 * common gain of exposures, and Android's noise model. */
SensorNoise_EXPORT std::vector<std::string>
FindingsOf(const SweepSummary & summary);

/** Returns the sweep as one HTML page, without network access and scripts: the findings, gain and read noise against
 * the setting on logarithmic axes, and the table. */
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
