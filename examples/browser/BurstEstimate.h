// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef BurstEstimate_h
#define BurstEstimate_h

#include "browser/Burst.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <variant>
#include <vector>

namespace sensornoise::browser
{

/** Result of an estimate: the reports, and the maps of the page. */
struct BurstResult
{
  std::variant<Report, ChannelReports> reports{};
  std::vector<double>                  mean{};     ///< temporal mean of the pixels [DN]; empty: none
  std::vector<std::uint8_t>            pixelUse{}; ///< values of PixelUse; empty: none
};

/** Measures the burst with one thread, with the settings and the results of estimate-sensor-noise. \a dark: dark
 * frames; null: none. Throws std::invalid_argument for wrong options, and what Burst::read throws. */
BurstResult
EstimateBurst(const Burst & burst, const Burst * dark, const BurstOptions & options, const BurstProgress & progress);

} // namespace sensornoise::browser

#endif
