/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
  std::vector<std::string>           warnings; ///< codes, in the report's order
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
  HasWarning(const std::string & code) const;
};

/** Simulates a stack of size x size pixels, and dark frames where the setting has them, estimates with the refined
 * method and compares. Truth of the gain: mean over the pixels that the estimate used of d(mean code) / d(electron); of
 * the offset: mean over the same of the mean code without light; of the flicker: what the stack really had; of the
 * read noise: root mean square, and median, over all pixels; of row and column noise: the setting. */
RealSensorOutcome
MeasureRealSensor(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed);

} // namespace sensornoise::tools

#endif
