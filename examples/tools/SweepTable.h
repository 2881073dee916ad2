// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SweepTable_h
#define SweepTable_h

#include "sweep/Setting.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** A line of the table of --sweep. */
struct SweepTableRow
{
  NamedSetting setting;
  std::string  frames; ///< file, folder or pattern
  std::string  dark;   ///< dark frames: file, folder or pattern; "": none
};

/** Reads the table of --sweep: a header with the columns iso, gain, gain_db, exposure or exposure_ms, frames and, if
 * there are dark frames, dark; then a line for each setting. Columns are separated by commas, semicolons or tabs. Empty
 * lines and lines that begin with # are skipped. Names become relative to the folder of the table. Throws
 * std::runtime_error, which names the line, if the file cannot be read, a column is missing or unknown, there are two
 * columns of settings, or a setting is no number or not above 0. */
std::vector<SweepTableRow>
ReadSweepTable(const std::string & file);

} // namespace sensornoise::tools

#endif
