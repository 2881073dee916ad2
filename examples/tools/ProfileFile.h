// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ProfileFile_h
#define ProfileFile_h

#include "exports/NoiseProfile.h"
#include "tools/ModelCheck.h"

#include <string>

namespace sensornoise::tools
{

/** Reads a noise profile of another program, or a report. Throws std::runtime_error if \a file cannot be read, and
 * ExportError if it is no profile or does not determine the variance. */
NoiseProfile
ReadProfileFile(const std::string & file);

/** Compares the variance of the measured frames with a profile, channel by channel. \a settings replaces the black and
 * the white level of the frames' files. A DNG file with a profile gives them if neither does. The reason why a
 * channel is not compared is reported on standard error. */
ModelChecks
CheckProfile(const NoiseProfile & profile, const MeasuredStack & measured, const ExportSettings & settings);

} // namespace sensornoise::tools

#endif
