// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ToolArguments_h
#define ToolArguments_h

#include "browser/Burst.h"

#include <string>
#include <vector>

namespace sensornoise::browser
{

/** Files and options of a request. The page gives dark frames names below "dark/". */
struct ToolRequest
{
  std::vector<std::string> files{};
  std::vector<std::string> dark{};
  std::string              raw{}; ///< layout of files without a header; "": they have one
  BurstOptions             options{};
};

/** Returns the arguments with which estimate-sensor-noise does what is requested, as they are typed in a shell. More
 * than four files are named by their folder, else by the ending that all have, else by FRAMES or DARK. */
std::string
ArgumentsOfTool(const ToolRequest & request);

} // namespace sensornoise::browser

#endif
