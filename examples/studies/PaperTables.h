// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef PaperTables_h
#define PaperTables_h

#include <array>
#include <string>

namespace sensornoise::tools
{

/** The parameters of Tables 2 and 3, in their order. */
inline constexpr std::array<const char *, 7> TableParameters{ "gain",          "offset",     "read_noise",
                                                              "intercept",     "flicker_sd", "vibration_sd_x",
                                                              "vibration_sd_y" };

/** What Sur & Gredi'ac 2015 print for the proposed method: mean and twice the standard deviation over 50 runs, for each
 * of TableParameters. \a table is 2 (their Synthetic target) or 3 (Boat; cells that the available text of the paper
 * leaves unreadable are empty), \a experiment is for example "A1". */
std::array<std::string, 7>
PaperFigures(int table, const std::string & experiment);

} // namespace sensornoise::tools

#endif
