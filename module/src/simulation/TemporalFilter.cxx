// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/TemporalFilter.h"

#include "simulation/SettingChecks.h"

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
