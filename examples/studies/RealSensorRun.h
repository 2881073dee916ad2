// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorRun_h
#define RealSensorRun_h

#include "studies/RealSensorJudged.h"
#include "studies/RealSensorSetting.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What became of one stack. */
struct RealSensorOutcome
{
  std::uint64_t                      seed{ 0 };
  std::array<Judged, NumberOfJudged> judged;
  std::vector<WarningCode>           warnings; ///< in the report's order
  std::string                        kind;     ///< of the noise, as KindOf() has it
  /** Where frames are repeated: the gain of the stack without the repetitions; null: none. */
  std::optional<double> distinctGain;
  /** Departure of the variance from a line [1]; null: the report has none. */
  std::optional<double> nonlinearity;
  /** Shares of the pixels whose own 95 % intervals for offset and read noise hold the truth; null: no such maps. */
  std::optional<double> offsetMapCoverage;
  std::optional<double> readNoiseMapCoverage;

  const Judged &
  Of(JudgedQuantity quantity) const
  {
    return judged[static_cast<std::size_t>(quantity)];
  }
  bool
  IsRefused() const
  {
    return Of(JudgedQuantity::Gain).estimate.status == EstimateStatus::Failed;
  }
  bool
  HasWarning(WarningCode code) const;
};

/** Simulates a stack of size x size pixels, and dark frames where the setting has them, estimates with the refined
 * method and compares. Truth of the gain: mean over the pixels that the estimate used of d(mean code) / d(electron); of
 * the offset: mean over the same of the mean code without light; of the flicker: what the stack really had; of the
 * read noise: root mean square, and median, over all pixels; of row and column noise: the setting. */
RealSensorOutcome
MeasureRealSensor(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed);

} // namespace sensornoise::tools

#endif
