// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SweepFiles_h
#define SweepFiles_h

#include "sweep/Setting.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{
struct EstimateOptions;

/** The burst of one setting of a camera. */
struct SweepBurst
{
  std::string              name; ///< name of the folder or file of the burst
  std::vector<std::string> files;
  std::vector<std::string> dark;    ///< dark frames at the same setting; empty: none
  std::optional<double>    setting; ///< ISO speed, gain as a factor, or exposure [s]; none: not known
  std::string              reason;  ///< reason why it cannot be measured; "": it can be measured
};

/** Bursts of a camera in the order of their settings. Bursts without a setting are last. */
struct SweepPlan
{
  SettingKind             kind{ SettingKind::Iso };
  std::vector<SweepBurst> bursts;
};

/** Finds the bursts of --sweep.
 *
 * A file that ends in .csv is a table with a header: the column iso, gain, gain_db, exposure or exposure_ms, the column
 * frames with a file, a folder or a pattern, and dark, which may be empty. Names are relative to the table. Otherwise a
 * folder with folders has a burst in each of them, and dark frames in its folder "dark"; several folders are a burst
 * each. Files are grouped by the ISO speed that they record, or by the exposure if all record one ISO speed; a stack is
 * a burst of its own. The setting that the first file of a burst records counts before its name. Pixels are not read.
 *
 * A burst that cannot be measured has a reason: no image in its folder, no setting, a setting that another burst has,
 * or a setting in the files that differs from the name or the table; of exposures, an ISO speed that differs from the
 * others. Throws std::invalid_argument or std::runtime_error if the table cannot be read, a single frame has no ISO
 * speed, settings of several kinds are mixed, or there is no burst. */
SweepPlan
FindBursts(const std::vector<std::string> & names, const EstimateOptions & options);

} // namespace sensornoise::tools

#endif
