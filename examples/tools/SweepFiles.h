// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SweepFiles_h
#define SweepFiles_h

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{
struct EstimateOptions;

/** The burst of one setting of a camera. */
struct SweepBurst
{
  std::string              name; ///< of its folder or file
  std::vector<std::string> files;
  std::vector<std::string> dark;    ///< dark frames at the same setting; empty: none
  std::optional<double>    setting; ///< ISO speed, or gain as a factor; none: not known
  std::string              reason;  ///< why it cannot be measured; "": it can
};

/** The bursts of a camera, by their setting; those without one are the last. */
struct SweepPlan
{
  bool                    isIso{ true };
  std::vector<SweepBurst> bursts;
};

/** A setting that a name or a table gives. */
struct NamedSetting
{
  bool   isIso{ true };
  double value{ 0.0 }; ///< ISO speed, or gain as a factor
};

/** Returns the setting in the name of a folder or a stack: "iso800", "ISO 800", "800" (an ISO speed), "gain2.5", or
 * "gain6dB", which is a factor of 2. Letters may stand before and behind "iso800" and "gain2.5". Empty if there is
 * none, or it is not above 0. */
std::optional<NamedSetting>
SettingInName(const std::string & name);

/** Finds the bursts of --sweep.
 *
 * A file that ends in .csv is a table with a header: the column iso, gain or gain_db, the column frames with a file, a
 * folder or a pattern, and dark, which may be empty. Names are relative to the table. Otherwise a folder with folders
 * has a burst in each of them, and dark frames in its folder "dark"; several folders are a burst each. Files are
 * grouped by the ISO speed that they record; a stack is a burst of its own. The ISO speed of the first file of a burst
 * counts before its name. Pixels are not read.
 *
 * A burst that cannot be measured has a reason: no image in its folder, no setting, a setting that another burst has,
 * or an ISO speed in the files that differs from the name or the table. Throws std::invalid_argument or
 * std::runtime_error if the table cannot be read, a single frame has no ISO speed, gains and ISO speeds are mixed, or
 * there is no burst. */
SweepPlan
FindBursts(const std::vector<std::string> & names, const EstimateOptions & options);

} // namespace sensornoise::tools

#endif
