// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_GainLevel_h
#define sensornoise_sweep_GainLevel_h

#include "sweep/SettingNoise.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

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
  double chi2{ 0.0 }; ///< the same of the settings on the level alone
  std::size_t settings{ 0 }; ///< settings on the level
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

} // namespace sensornoise

#endif
