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
#include "sensornoise/simulation/TemporalFilter.h"

#include "sensornoise/simulation/SettingChecks.h"

#include <utility>

namespace sensornoise
{

void
CheckSettings(const TemporalFilterSettings & settings)
{
  RequireSetting(settings.weight >= 0.0 && settings.weight <= 0.99,
                 "weight of the last frame in the temporal filter",
                 settings.weight,
                 "0 to 0.99");
}

TemporalFilter::TemporalFilter(const TemporalFilterSettings & settings)
  : m_Weight(settings.weight)
{}

DoubleFrame
TemporalFilter::OutputFrame(std::size_t frame, const InputFrame & inputOf, const ParallelFor & parallelFor)
{
  std::shared_ptr<const State> last;
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    last = m_Last;
  }
  const bool  goesOn = last && last->frame <= frame;
  std::size_t t = goesOn ? last->frame : 0;
  DoubleFrame output = goesOn ? last->output : inputOf(0);
  while (t < frame)
  {
    const DoubleFrame input = inputOf(++t);
    parallelFor(output.height, [&](std::size_t y) {
      for (std::size_t x = 0; x < output.width; ++x)
      {
        output.Row(y)[x] = (1.0 - m_Weight) * input.Row(y)[x] + m_Weight * output.Row(y)[x];
      }
    });
  }
  const auto                        state = std::make_shared<const State>(State{ frame, output });
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Last = state;
  return output;
}

} // namespace sensornoise
