// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ExportInput_h
#define sensornoise_exports_ExportInput_h

#include "sensornoise/NoiseExport.h"
#include "sensornoise/NoiseModel.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** The variance on the scale where the black level is 0 and the white level is 1: scale x + offset. */
struct NormalisedLine
{
  double scale{ 0.0 };  ///< S = a / (W - B)
  double offset{ 0.0 }; ///< O = (b + a B) / (W - B)^2
};

/** The parameters of a sensor in the units of most records. */
struct SensorNumbers
{
  double offsetDn{ 0.0 };
  double electronsPerDn{ 0.0 };
  double readNoiseElectrons{ 0.0 };
};

/** The only channel. Throws ExportError, with the name of the \a format, if the report has several. */
const ChannelNoise &
OnlyChannel(const CameraNoise & noise, const std::string & format);

/** The noise model of a channel. Throws ExportError if it is not identified or its slope is not above 0. */
NoiseModel
ModelOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The line of a channel between the black and the white level. Throws ExportError if a level is missing, or the
 * variance at the black level is negative. */
NormalisedLine
NormalisedLineOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The gain of a channel [DN/e-]. Throws ExportError if it is not identified. */
double
GainOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The dark offset of a channel [DN]. Throws ExportError if it is not identified. */
double
OffsetOf(const CameraNoise & noise, const ChannelNoise & channel);

/** Offset, electrons per DN and read noise of a channel. Throws ExportError if one is not identified. */
SensorNumbers
SensorNumbersOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The black level, or the white level [DN]. Throws ExportError if it is missing. */
double
BlackLevelOf(const CameraNoise & noise);
double
WhiteLevelOf(const CameraNoise & noise);

/** Throws ExportError, with the name of the \a format, if a report has no ISO speed, or another number of channels than
 * the first one. */
void
RequireIsoSpeeds(const std::vector<CameraNoise> & settings, const std::string & format);

/** A file of this name with this text, alone. */
NoiseExport
OneFile(const std::string & name, const std::string & bytes, const std::string & note = {});

} // namespace sensornoise

#endif
